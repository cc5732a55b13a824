#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace pleat {

using nlohmann::json;

/// Holds a JSON value against the part of JSON Schema 2020-12 that the scene's schema uses,
/// independently of the reader.
class SchemaWalk {
 public:
  explicit SchemaWalk(const json& schema) : root_(schema) { check_keywords(root_, "#"); }

  /// Empty when the value is valid, else the pointer and keyword of the first violation.
  std::string violation(const json& value) { return check(root_, "#", value, ""); }

  /// Schema pointers of the properties that valid values had so far.
  const std::set<std::string>& seen_properties() const { return seen_; }
  /// Schema pointers of all properties.
  const std::set<std::string>& all_properties() const { return all_; }
  /// Called with the schema of each property of a valid value, its own value and its pointer there.
  std::function<void(const json& schema, const json& value, const std::string& pointer)> visit;

 private:
  /// A keyword that the walk does not know would be passed over in silence.
  void check_keywords(const json& schema, const std::string& place) {
    static const std::set<std::string> known{"$schema",
                                             "$defs",
                                             "$ref",
                                             "title",
                                             "description",
                                             "examples",
                                             "type",
                                             "properties",
                                             "required",
                                             "additionalProperties",
                                             "default",
                                             "enum",
                                             "const",
                                             "oneOf",
                                             "anyOf",
                                             "items",
                                             "minItems",
                                             "maxItems",
                                             "minProperties",
                                             "minimum",
                                             "maximum",
                                             "exclusiveMinimum",
                                             "exclusiveMaximum",
                                             "maxProperties"};
    for (const auto& item : schema.items())
      if (known.count(item.key()) == 0)
        throw std::runtime_error("unknown keyword " + item.key() + " at " + place);
    for (const char* group : {"properties", "$defs"}) {
      if (!schema.contains(group)) continue;
      for (const auto& item : schema.at(group).items()) {
        const std::string inner = place + "/" + group + "/" + item.key();
        if (group == std::string("properties")) all_.insert(inner);
        check_keywords(item.value(), inner);
      }
    }
    for (const char* group : {"oneOf", "anyOf"}) {
      if (!schema.contains(group)) continue;
      for (std::size_t k = 0; k < schema.at(group).size(); ++k)
        check_keywords(schema.at(group)[k], place + "/" + group + "/" + std::to_string(k));
    }
    for (const char* each : {"items", "additionalProperties"})
      if (schema.contains(each) && schema.at(each).is_object())
        check_keywords(schema.at(each), place + "/" + each);
  }

  static bool has_type(const json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "number") return value.is_number();
    if (type == "integer")
      return value.is_number() && value.get<double>() == std::floor(value.get<double>());
    throw std::runtime_error("unknown type " + type);
  }

  std::string check_number(const json& schema, double number, const std::string& pointer) const {
    if (schema.contains("minimum") && number < schema["minimum"].get<double>())
      return pointer + " minimum";
    if (schema.contains("maximum") && number > schema["maximum"].get<double>())
      return pointer + " maximum";
    if (schema.contains("exclusiveMinimum") && number <= schema["exclusiveMinimum"].get<double>())
      return pointer + " exclusiveMinimum";
    if (schema.contains("exclusiveMaximum") && number >= schema["exclusiveMaximum"].get<double>())
      return pointer + " exclusiveMaximum";
    return "";
  }

  std::string check_array(const json& schema, const std::string& place, const json& value,
                          const std::string& pointer) {
    if (schema.contains("minItems") && value.size() < schema["minItems"].get<std::size_t>())
      return pointer + " minItems";
    if (schema.contains("maxItems") && value.size() > schema["maxItems"].get<std::size_t>())
      return pointer + " maxItems";
    if (!schema.contains("items")) return "";
    for (std::size_t k = 0; k < value.size(); ++k) {
      std::string found =
          check(schema["items"], place + "/items", value[k], pointer + "/" + std::to_string(k));
      if (!found.empty()) return found;
    }
    return "";
  }

  std::string check_object(const json& schema, const std::string& place, const json& value,
                           const std::string& pointer) {
    for (const json& key : schema.value("required", json::array()))
      if (!value.contains(key.get<std::string>()))
        return pointer + " required " + key.get<std::string>();
    if (schema.contains("minProperties") &&
        value.size() < schema["minProperties"].get<std::size_t>())
      return pointer + " minProperties";
    if (schema.contains("maxProperties") &&
        value.size() > schema["maxProperties"].get<std::size_t>())
      return pointer + " maxProperties";
    const json properties = schema.value("properties", json::object());
    const json others = schema.value("additionalProperties", json::object());
    for (const auto& item : value.items()) {
      const bool is_named = properties.contains(item.key());
      if (!is_named && others == json(false))
        return pointer + "/" + item.key() + " additionalProperties";
      const json& property = is_named ? properties[item.key()] : others;
      const std::string inner =
          place + (is_named ? "/properties/" + item.key() : "/additionalProperties");
      std::string found = check(property, inner, item.value(), pointer + "/" + item.key());
      if (!found.empty()) return found;
      if (n_trials_ > 0) continue;
      if (is_named) seen_.insert(inner);
      if (visit) visit(property, item.value(), pointer + "/" + item.key());
    }
    return "";
  }

  std::string check_choices(const json& choices, const std::string& place, const json& value,
                            const std::string& pointer) {
    const auto is_valid = [&](std::size_t k) {
      return check(choices[k], place + "/" + std::to_string(k), value, pointer).empty();
    };
    std::vector<std::size_t> valid;
    ++n_trials_;
    for (std::size_t k = 0; k < choices.size(); ++k)
      if (is_valid(k)) valid.push_back(k);
    --n_trials_;
    if (valid.size() != 1) return pointer + " " + std::to_string(valid.size()) + " choices";
    is_valid(valid[0]);  // again, to note what it has
    return "";
  }

  std::string check(const json& schema, const std::string& place, const json& value,
                    const std::string& pointer) {
    if (schema.contains("$ref")) {
      const std::string target = schema["$ref"].get<std::string>();
      std::string found =
          check(root_.at(json::json_pointer(target.substr(1))), target, value, pointer);
      if (!found.empty()) return found;
    }
    if (schema.contains("type") && !has_type(value, schema["type"])) return pointer + " type";
    if (schema.contains("const") && value != schema["const"]) return pointer + " const";
    if (schema.contains("enum") &&
        std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
      return pointer + " enum";
    for (const char* group : {"oneOf", "anyOf"}) {
      if (!schema.contains(group)) continue;
      std::string found = check_choices(schema[group], place + "/" + group, value, pointer);
      if (!found.empty()) return found;
    }
    if (value.is_number()) return check_number(schema, value.get<double>(), pointer);
    if (value.is_array()) return check_array(schema, place, value, pointer);
    if (value.is_object()) return check_object(schema, place, value, pointer);
    return "";
  }

  const json& root_;
  int n_trials_ = 0;  // choices being tried: what they have is not seen yet
  std::set<std::string> seen_;
  std::set<std::string> all_;
};

}  // namespace pleat
