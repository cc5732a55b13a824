#include "core/scene/scene_schema.h"

namespace pleat {
namespace {

/// The schema of a setting under this stepper, added to the one under any. Solvers have no default
/// here where that depends on the build.
Json setting_schema(const StepperType& type, MethodSetting setting) {
  const MethodOptions usual = type.usual_method();
  Json schema = Json::object();
  switch (setting) {
    case MethodSetting::substeps:
      if (!type.has_stability_bound) schema["type"] = "integer";
      schema["default"] = usual.substeps == 0 ? Json("stable") : Json(usual.substeps);
      break;
    case MethodSetting::iterations:
      schema["default"] = usual.iterations;
      break;
    case MethodSetting::solver:
      if (type.needs_factor)
        schema["enum"] = Json::array({"cholmod", "supernodal", "eigen"});
      else if (type.prefers_factor)
        schema["enum"] = Json::array({"cholmod", "supernodal", "eigen", "cg"});
      else
        schema["default"] = name(usual.solver);
      break;
    case MethodSetting::tolerance:
      if (type.largest_tolerance < 1) schema["maximum"] = type.largest_tolerance;
      schema["default"] = usual.tolerance;
      break;
    case MethodSetting::constraints:
      schema["default"] = usual.constraints == Constraints::rigid ? "rigid" : "compliant";
      break;
    case MethodSetting::attachments:
      schema["default"] = usual.attachments == Attachments::none ? "none" : "long_range";
      break;
    case MethodSetting::level_lengths:
      schema["default"] = usual.level_lengths == LevelLengths::surface ? "surface" : "chord";
      break;
    case MethodSetting::omega:
    case MethodSetting::preconditioner:
    case MethodSetting::split:
    case MethodSetting::rule:
    case MethodSetting::acceleration:
    case MethodSetting::explicit_share:
    case MethodSetting::euler:
    case MethodSetting::beyond_bound:
    case MethodSetting::first_contact:
    case MethodSetting::levels:
    case MethodSetting::ratio:
    case MethodSetting::smoother_before:
    case MethodSetting::smoother:
    case MethodSetting::carried_acceleration:
      break;
  }
  return schema;
}

/// A section "method" with this stepper.
Json stepper_schema(const StepperType& type) {
  Json schema;
  schema["additionalProperties"] = false;
  if (&type != MethodOptions{}.stepper) schema["required"] = Json::array({"stepper"});
  Json& properties = schema["properties"];
  properties["stepper"]["const"] = type.name;
  properties["step_s"] = Json::object();
  for (const MethodSetting setting : type.settings)
    properties[key(setting)] = setting_schema(type, setting);
  return schema;
}

}  // namespace

Json scene_schema(StepperTable steppers) {
  Json schema = parse_json(scene_schema_file());
  Json& method = schema["properties"]["method"];
  Json& names = method["properties"]["stepper"]["enum"] = Json::array();
  Json& alternatives = method["oneOf"] = Json::array();
  for (const StepperType* type : steppers) {
    names.push_back(type->name);
    alternatives.push_back(stepper_schema(*type));
  }
  return schema;
}

}  // namespace pleat
