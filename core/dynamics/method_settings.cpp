#include "core/dynamics/method_settings.h"

#include "core/base/check.h"

namespace pleat {
namespace {

bool is_in_range(const WordField& field, const MethodOptions& method) {
  return field.get(method) < field.words.size();
}

template <class Number>
bool is_in_range(const NumberField<Number>& field, const MethodOptions& method) {
  const Number number = method.*field.member;
  return field.range.contains(number) || (number == 0 && field.zero.is_for(*method.stepper));
}

}  // namespace

bool MethodSetting::is_idle(const MethodOptions& method) const {
  bool depends = false;
  for (const Beside& known : beside) {
    const MethodSetting* other = method.stepper->setting(known.key);
    if (other == nullptr) continue;
    if (std::get<WordField>(other->field).word(method) == std::string_view(known.word))
      return false;
    depends = true;
  }
  return depends;
}

void MethodOptions::validate() const {
  PLEAT_CHECK(stepper != nullptr, "a method has a stepper");
  PLEAT_CHECK(step > 0, "a step is positive");
  const auto check = [this](const MethodSetting& setting) {
    PLEAT_CHECK(
        std::visit([&](const auto& field) { return is_in_range(field, *this); }, setting.field),
        setting.key);
  };
  for (const MethodSetting& setting : kMethodSettings)
    if (!std::holds_alternative<WordField>(setting.field)) check(setting);
  for (const MethodSetting* setting : stepper->settings) check(*setting);
}

}  // namespace pleat
