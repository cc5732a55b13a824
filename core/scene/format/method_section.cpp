#include "core/scene/format/method_section.h"

#include <algorithm>
#include <cmath>

#include "core/dynamics/method_settings.h"

namespace pleat {
namespace {

constexpr std::array<Word<FrameFormat>, 4> kFrameFormats{{{"obj", FrameFormat::obj},
                                                          {"ply", FrameFormat::ply},
                                                          {"binary", FrameFormat::binary},
                                                          {"none", FrameFormat::none}}};

const StepperType& read_stepper(const JsonReader& reader, StepperTable steppers) {
  std::vector<const char*> names;
  for (const StepperType* type : steppers) names.push_back(type->name);
  return *steppers[reader.one_of(names)];
}

/// Refuses keys that are no setting, and settings that this stepper does not read.
void check_settings(const JsonReader& reader, const StepperType& type, StepperTable steppers) {
  const std::vector<const MethodSetting*> all = all_settings(steppers);
  std::vector<const char*> known = {"stepper", "step_s"};
  for (const MethodSetting* setting : all) known.push_back(setting->key);
  reader.allow_keys(known);
  for (const MethodSetting* setting : all)
    if (const auto at = reader.find(setting->key); at && !type.reads(setting->key))
      at->fail("no such key, as " + std::string(type.name) + " does not read it");
}

/// True where the word for 0 stands. Refuses other texts.
bool is_zero(const ZeroWord& zero, const std::string& number, const JsonReader& reader,
             const StepperType& type) {
  if (zero.text == nullptr || !reader.is_text()) return false;
  if (!zero.is_for(type)) reader.fail(number + ", as " + type.name + " " + zero.refusal);
  if (reader.text() != zero.text) reader.fail(number + " or \"" + zero.text + '"');
  return true;
}

template <class Number>
void read_field(const NumberField<Number>& field, const JsonReader& reader, MethodOptions& method) {
  constexpr bool is_count = std::is_same_v<Number, int>;
  const StepperType& type = *method.stepper;
  auto [low, high, ends] = field.range;
  if (field.most != nullptr && type.*field.most < high) {
    high = type.*field.most;
    ends = NumberRange::Ends::low_excluded;
  }
  Number& value = method.*field.member;
  if (is_zero(field.zero, is_count ? "a whole number" : "a number", reader, type))
    value = 0;
  else if constexpr (is_count)
    value = static_cast<int>(reader.integer(std::lround(low), std::lround(high)));
  else
    value = reader.number({low, high, ends});
}

void read_field(const WordField& field, const JsonReader& reader, MethodOptions& method) {
  field.set(method, reader.one_of(field.words));
}

template <class Number>
Json json_field(const NumberField<Number>& field, const MethodOptions& method) {
  const Number number = method.*field.member;
  return number == 0 && field.zero.text != nullptr ? Json(field.zero.text) : Json(number);
}

Json json_field(const WordField& field, const MethodOptions& method) { return field.word(method); }

Json json_setting(const MethodSetting& setting, const MethodOptions& method) {
  return std::visit([&](const auto& field) { return json_field(field, method); }, setting.field);
}

/// Refuses a value of no effect: "beside a smoother other than sor and jacobi".
[[noreturn]] void refuse_idle(const JsonReader& reader, const MethodSetting& setting,
                              const MethodOptions& method) {
  const MethodSetting* other = nullptr;
  std::vector<std::string> words;
  for (const Beside& known : setting.beside) {
    if (other == nullptr) other = method.stepper->setting(known.key);
    if (other != nullptr && other->key == std::string_view(known.key)) words.push_back(known.word);
  }
  const std::string key = other->key;
  reader.fail("no such key beside " +
              (words.size() > 1
                   ? "a " + key + " other than " + words[0] + " and " + words[1]
                   : "the " + key + " " + json_setting(*other, method).get<std::string>() +
                         ", but beside " + words[0]));
}

/// Rough cost of a substep of one iteration, see StepperType::substep_cost.
double substep_work(const StepperType& type) {
  MethodOptions method = type.usual_method();
  method.iterations = 1;
  return type.substep_cost(method);
}

/// True where the page offers what the setting goes with, too: omega is one of smoothers, but not
/// of imex, whose solver is not offered.
bool offers(const StepperType& type, const MethodSetting& setting) {
  if (setting.title == nullptr || !type.reads(setting.key)) return false;
  return setting.beside.empty() ||
         std::any_of(setting.beside.begin(), setting.beside.end(), [&](const Beside& known) {
           const MethodSetting* other = type.setting(known.key);
           return other != nullptr && other->title != nullptr;
         });
}

/// The numbers between which a setting lies, and by which steps it is usually changed.
template <class Number>
void put_values(const NumberField<Number>& field, Json& json) {
  const auto [low, high, ends] = field.range;
  const int inside = ends == NumberRange::Ends::excluded ? 1 : 0;
  json["least"] = (std::round(low * field.steps_per_unit) + inside) / field.steps_per_unit;
  json["most"] = (std::round(high * field.steps_per_unit) - inside) / field.steps_per_unit;
  json["step"] = 1.0 / field.steps_per_unit;
}

void put_values(const WordField& field, Json& json) {
  for (std::size_t i = 0; i < field.titles.size(); ++i)
    json["words"].push_back({{"value", field.words[i]}, {"title", field.titles[i]}});
}

/// A count with what it starts from and what more of it does.
Json json_count(const StepperType& type, const char* key, const char* meaning) {
  const MethodSetting& setting = *type.setting(key);
  const auto& field = std::get<CountField>(setting.field);
  Json json;
  json["start"] = json_setting(setting, type.usual_method());
  json["least"] =
      field.zero.is_for(type) ? Json(field.zero.text) : Json(std::lround(field.range.low));
  json["meaning"] = meaning;
  return json;
}

Json json_stepper(const StepperType& type, StepperTable steppers) {
  const bool counts_rounds = type.reads("iterations");
  const MethodOptions usual = type.usual_method();
  Json json;
  json["name"] = type.name;
  json["title"] = type.title;
  json["meaning"] = type.meaning;
  json["needs_springs"] = type.needs_springs;
  json["solves"] = type.solves_equations;
  json["settings"]["substeps"] = json_count(type, "substeps", type.substeps_meaning);
  if (counts_rounds)
    json["settings"]["iterations"] = json_count(type, "iterations", type.iterations_meaning);
  json["details"] = Json::object();
  for (const MethodSetting* setting : all_settings(steppers))
    if (offers(type, *setting)) json["details"][setting->key] = json_setting(*setting, usual);
  json["sweep"] = Json::array();
  for (const MethodCounts& counts : type.usual_counts) {
    MethodOptions method = usual;
    method.substeps = counts.substeps;
    Json swept;
    swept["substeps"] = json_setting(*type.setting("substeps"), method);
    if (counts_rounds) swept["iterations"] = counts.iterations;
    json["sweep"].push_back(swept);
  }
  json["solves_whole_substeps"] = type.solves_whole_substeps;
  json["substep_work"] = substep_work(type);
  json["models"] = Json::array();
  if (type.is_usual_for_springs) json["models"].push_back("springs");
  if (type.is_usual_for_membranes) json["models"].push_back("membrane");
  json["finest_sweep_level"] = type.finest_usual_level;
  json["mark"] = type.mark.path;
  json["colour"] = type.mark.colour;
  json["dark_colour"] = type.mark.dark_colour;
  return json;
}

}  // namespace

MethodOptions read_method(const JsonReader& reader, StepperTable steppers) {
  const auto named = reader.find("stepper");
  const StepperType& type = named ? read_stepper(*named, steppers) : *MethodOptions{}.stepper;
  check_settings(reader, type, steppers);
  const MethodOptions usual = type.usual_method();
  MethodOptions method = usual;
  if (const auto at = reader.find("step_s")) method.step = at->number(kPositive);
  for (const MethodSetting* setting : type.settings)
    if (const auto at = reader.find(setting->key))
      std::visit([&](const auto& field) { read_field(field, *at, method); }, setting->field);
  for (const MethodSetting* setting : type.settings)
    if (setting->is_idle(method) && json_setting(*setting, method) != json_setting(*setting, usual))
      refuse_idle(reader.at(setting->key), *setting, method);
  return method;
}

Json json_method(const MethodOptions& method) {
  Json json;
  json["stepper"] = method.stepper->name;
  json["step_s"] = method.step;
  for (const MethodSetting* setting : method.stepper->settings)
    if (!std::holds_alternative<WordField>(setting->field) || !setting->is_idle(method))
      json[setting->key] = json_setting(*setting, method);
  return json;
}

Json json_steppers(StepperTable steppers) {
  Json rows = Json::array();
  for (const StepperType* type : steppers) rows.push_back(json_stepper(*type, steppers));
  return rows;
}

Json json_method_details(StepperTable steppers) {
  Json details = Json::array();
  for (const MethodSetting* setting : all_settings(steppers)) {
    if (setting->title == nullptr) continue;
    Json json;
    json["key"] = setting->key;
    json["title"] = setting->title;
    json["meaning"] = setting->meaning;
    std::visit([&](const auto& field) { put_values(field, json); }, setting->field);
    for (const Beside& known : setting->beside) json["beside"][known.key].push_back(known.word);
    details.push_back(json);
  }
  return details;
}

void read_record(const JsonReader& reader, RecordOptions& record) {
  reader.allow_keys({"every_s", "format"});
  if (const auto at = reader.find("every_s")) record.every = at->number(kPositive);
  if (const auto at = reader.find("format")) record.format = at->word(kFrameFormats);
}

Json json_record(const RecordOptions& record) {
  Json json;
  json["every_s"] = record.every;
  json["format"] = word_for(kFrameFormats, record.format);
  return json;
}

}  // namespace pleat
