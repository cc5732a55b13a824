#include "native-tests/support/scene_schema.h"

#include "core/dynamics/method_settings.h"
#include "core/scene/format/method_section.h"
#include "native-tests/support/assets.h"

namespace pleat {
namespace {

Json with_zero(const ZeroWord& zero, const Json& number) {
  if (zero.text == nullptr) return number;
  Json schema;
  schema["anyOf"] = Json::array({number, {{"const", zero.text}}});
  return schema;
}

template <class Number>
Json values(const NumberField<Number>& field) {
  const auto [low, high, ends] = field.range;
  if (high == kLargestNumber) return {{"$ref", "#/$defs/not_negative"}};
  const bool is_open = ends == NumberRange::Ends::excluded;
  return with_zero(field.zero, {{"type", std::is_same_v<Number, int> ? "integer" : "number"},
                                {is_open ? "exclusiveMinimum" : "minimum", low},
                                {is_open ? "exclusiveMaximum" : "maximum", high}});
}

Json values(const WordField& field) {
  Json schema;
  schema["enum"] = field.words;
  return schema;
}

/// The schema of a setting under any stepper. `known` has what is said of it to people.
Json any_schema(const MethodSetting& setting, const Json& known) {
  Json schema = std::visit([](const auto& field) { return values(field); }, setting.field);
  for (const char* key : {"default", "description"})
    if (known.contains(key)) schema[key] = known[key];
  return schema;
}

/// The schema of a setting under this stepper, added to the one under any. Solvers have no default
/// here where that depends on the build.
Json own_schema(const StepperType& type, const MethodSetting& setting, const Json& any) {
  Json schema = Json::object();
  const auto* count = std::get_if<CountField>(&setting.field);
  const auto* number = std::get_if<ShareField>(&setting.field);
  if (count != nullptr && count->zero.text != nullptr && !count->zero.is_for(type))
    schema["type"] = "integer";
  if (number != nullptr && number->most != nullptr && type.*number->most < number->range.high)
    schema["maximum"] = type.*number->most;
  if (setting.key == std::string("solver") && (type.needs_factor || type.prefers_factor)) {
    schema["enum"] = {"cholmod", "supernodal", "eigen"};
    if (!type.needs_factor) schema["enum"].push_back("cg");
  } else if (!any.contains("default")) {
    schema["default"] = json_method(type.usual_method())[setting.key];
  }
  return schema;
}

/// A section "method" with this stepper.
Json stepper_schema(const StepperType& type, const Json& settings) {
  Json schema;
  schema["additionalProperties"] = false;
  if (&type != MethodOptions{}.stepper) schema["required"] = Json::array({"stepper"});
  Json& properties = schema["properties"];
  properties["stepper"]["const"] = type.name;
  properties["step_s"] = Json::object();
  for (const MethodSetting* setting : type.settings)
    properties[setting->key] = own_schema(type, *setting, settings[setting->key]);
  return schema;
}

}  // namespace

Json scene_schema(StepperTable steppers) {
  Json schema = parse_json(repository_file("core/scene/scene_schema.json"));
  Json& method = schema["properties"]["method"];
  Json& properties = method["properties"];
  for (const MethodSetting* setting : all_settings(steppers))
    properties[setting->key] = any_schema(*setting, properties[setting->key]);
  Json& names = properties["stepper"]["enum"] = Json::array();
  Json& alternatives = method["oneOf"] = Json::array();
  for (const StepperType* type : steppers) {
    names.push_back(type->name);
    alternatives.push_back(stepper_schema(*type, properties));
  }
  return schema;
}

}  // namespace pleat
