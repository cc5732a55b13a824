#pragma once

#include <emscripten/val.h>

#include <functional>
#include <string>

#include "core/base/vec.h"

namespace pleat {

emscripten::val json_value(const std::string& text);

template <class Items>
emscripten::val json_array(const Items& items) {
  emscripten::val array = emscripten::val::array();
  for (const auto& item : items) array.call<void>("push", item);
  return array;
}

emscripten::val json_triple(const Vec3& v);

/// The JSON text of an envelope that `work` fills in: {"ok": true, ...}, or, when it throws,
/// {"ok": false, "kind", "where", "what"}. No C++ exception may leave the bindings, JavaScript
/// would see a bare pointer.
std::string guarded(const std::function<void(emscripten::val& envelope)>& work);

}  // namespace pleat
