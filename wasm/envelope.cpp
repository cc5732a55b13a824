#include "wasm/envelope.h"

#include <vector>

#include "core/base/check.h"

namespace pleat {
namespace {

using emscripten::val;

std::string json_text(const val& object) {
  return val::global("JSON").call<std::string>("stringify", object);
}

std::string failure(const std::string& kind, const std::string& where, const std::string& what) {
  val envelope = val::object();
  envelope.set("ok", false);
  envelope.set("kind", kind);
  envelope.set("where", where);
  envelope.set("what", what);
  return json_text(envelope);
}

}  // namespace

val json_value(const std::string& text) { return val::global("JSON").call<val>("parse", text); }

val json_triple(const Vec3& v) { return json_array(std::vector<double>{v.x(), v.y(), v.z()}); }

std::string guarded(const std::function<void(val& envelope)>& work) {
  try {
    val envelope = val::object();
    envelope.set("ok", true);
    work(envelope);
    return json_text(envelope);
  } catch (const InputError& error) {
    return failure("input", error.where(), error.sentence());
  } catch (const std::exception& error) {
    return failure("internal", "", error.what());
  }
}

}  // namespace pleat
