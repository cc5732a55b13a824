// The settings of methods, a row each: whatever a scene, the command or the page says of one comes
// from here.
#pragma once

#include <array>
#include <span>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <variant>

#include "core/base/number_range.h"
#include "core/dynamics/stepper_type.h"

namespace pleat {

/// A word that scenes have in place of 0.
struct ZeroWord {
  const char* text = nullptr;          ///< null: 0 is a number like others
  bool StepperType::*taken = nullptr;  ///< holds for the steppers that take it; null: all do
  const char* refusal = "";            ///< why the others do not take it

  bool is_for(const StepperType& type) const {
    return text != nullptr && (taken == nullptr || type.*taken);
  }
};

template <class Number>
struct NumberField {
  Number MethodOptions::*member;
  NumberRange range;
  int steps_per_unit = 1;  ///< steps of the page's control per 1
  ZeroWord zero = {};
  double StepperType::*most = nullptr;  ///< the largest that a stepper takes, where that is less
};
using CountField = NumberField<int>;
using ShareField = NumberField<double>;

/// One of some words, which stand for the first values of an enumeration, in their order.
struct WordField {
  std::span<const char* const> words;
  std::span<const char* const> titles;  ///< words for people, where the page offers it
  std::size_t (*get)(const MethodOptions& method);
  void (*set)(MethodOptions& method, std::size_t value);

  const char* word(const MethodOptions& method) const {
    return get(method) < words.size() ? words[get(method)] : "";
  }
};

template <auto member>
constexpr WordField word_field(std::span<const char* const> words,
                               std::span<const char* const> titles = {}) {
  using Value = std::remove_reference_t<decltype(MethodOptions{}.*member)>;
  return {
      words, titles,
      [](const MethodOptions& method) { return static_cast<std::size_t>(method.*member); },
      [](MethodOptions& method, std::size_t value) { method.*member = static_cast<Value>(value); }};
}

/// A word of another setting.
struct Beside {
  const char* key;
  const char* word;
};

struct MethodSetting {
  const char* key;  ///< key in a scene's section "method"
  std::variant<CountField, ShareField, WordField> field;
  const char* title = nullptr;  ///< name for people; null: the page does not offer it
  const char* meaning = "";     ///< sentence for people
  /// It is of effect beside one of these, as far as its stepper reads them; empty: always.
  std::span<const Beside> beside = {};

  bool is_idle(const MethodOptions& method) const;
};

inline constexpr const char* kSplits[] = {"by_stability", "structural"};
inline constexpr const char* kNewtonRules[] = {"backward_euler", "midpoint", "equilibrium"};
inline constexpr const char* kAccelerations[] = {"none", "anderson"};
inline constexpr const char* kEulerRules[] = {"symplectic", "forward"};
inline constexpr const char* kBeyondBound[] = {"refuse", "go_on"};
inline constexpr const char* kLevelLengths[] = {"surface", "chord", "error"};
inline constexpr const char* kLevelLengthTitles[] = {"Along the surface", "Straight",
                                                     "By errors of the finer level"};
inline constexpr const char* kSmoothers[] = {"none", "jacobi", "gauss_seidel", "lines", "sor"};
inline constexpr const char* kSmootherTitles[] = {"None", "Jacobi", "Gauss-Seidel",
                                                  "Lines: whole threads", "SOR"};
inline constexpr const char* kAttachments[] = {"none", "long_range"};
inline constexpr const char* kAttachmentTitles[] = {"None", "Long range"};
inline constexpr const char* kConstraintWords[] = {"compliant", "rigid"};
inline constexpr const char* kConstraintTitles[] = {"Compliant", "Rigid"};

inline constexpr Beside kBesideCg[] = {{"solver", "cg"}};
inline constexpr Beside kBesideRelaxing[] = {{"smoother", "sor"},
                                             {"smoother", "jacobi"},
                                             {"smoother_before", "sor"},
                                             {"smoother_before", "jacobi"},
                                             {"solver", "sor"}};

/// All settings of Pleat's own steppers, in the order in which people are shown them.
inline constexpr MethodSetting kMethodSettings[] = {
    {"substeps",
     CountField{&MethodOptions::substeps,
                {1, kMaxSubsteps},
                1,
                {"stable", &StepperType::has_stability_bound, "has no bound to be stable at"}}},
    {"iterations", CountField{&MethodOptions::iterations, {1, kMaxSweeps}}},
    {"solver", word_field<&MethodOptions::solver>(kSolverNames)},
    {"tolerance", ShareField{&MethodOptions::tolerance,
                             {0, 1, NumberRange::Ends::excluded},
                             1,
                             {},
                             &StepperType::largest_tolerance}},
    {"preconditioner", word_field<&MethodOptions::preconditioner>(kPreconditionerNames), nullptr,
     "", kBesideCg},
    {"split", word_field<&MethodOptions::split>(kSplits)},
    {"rule", word_field<&MethodOptions::rule>(kNewtonRules)},
    {"acceleration", word_field<&MethodOptions::acceleration>(kAccelerations)},
    {"explicit_share", ShareField{&MethodOptions::explicit_share, {0, 1}}},
    {"euler", word_field<&MethodOptions::euler>(kEulerRules)},
    {"beyond_bound", word_field<&MethodOptions::beyond_bound>(kBeyondBound)},
    {"first_contact_m", ShareField{&MethodOptions::first_contact, kNotNegative}},
    // Any mesh has come to a level of one vertex before.
    {"levels", CountField{&MethodOptions::levels, {0, 30}}, "Coarser levels, number",
     "Meshes of fewer vertices that carry a pull far at once. 0: the cloth's own mesh alone."},
    {"ratio", ShareField{&MethodOptions::ratio, {0.1, 0.9, NumberRange::Ends::excluded}, 20},
     "Kept by a level, share of vertices",
     "The less a level keeps of the finer one, the cheaper it is, and the rougher."},
    {"level_lengths", word_field<&MethodOptions::level_lengths>(kLevelLengths, kLevelLengthTitles),
     "Lengths of levels",
     "Along the surface they act only when exceeded; straight ones act both ways, and iron folds; "
     "by errors they ask for what is still wrong on the finer level."},
    {"smoother_before", word_field<&MethodOptions::smoother_before>(kSmoothers, kSmootherTitles),
     "Smoother before", "How each level is swept on the way to coarser ones."},
    {"smoother", word_field<&MethodOptions::smoother_after>(kSmoothers, kSmootherTitles),
     "Smoother",
     "How springs are gone over once; where there are levels, on the way back. Lines solve all "
     "springs of a thread at once."},
    {"omega",
     ShareField{&MethodOptions::omega, {0, 2, NumberRange::Ends::excluded}, 20, {"estimated"}},
     "Omega, factor of corrections",
     "Of SOR, usually 1.1, and Jacobi, usually 1. Above 1 it reaches farther and smooths less.",
     kBesideRelaxing},
    {"attachments", word_field<&MethodOptions::attachments>(kAttachments, kAttachmentTitles),
     "Attachments", "Long range: no vertex further from a pin than unstretched cloth allows."},
    {"carried_acceleration",
     ShareField{&MethodOptions::carried_acceleration, {0, kMostCarried}, 20},
     "Carried acceleration, share",
     "With 0.3 cloth that swings loses as little energy as in several times as many substeps."},
    {"constraints", word_field<&MethodOptions::constraints>(kConstraintWords, kConstraintTitles),
     "Constraints", "Rigid ones do not give; compliant ones give as the fabric does."},
};

/// Rows by their keys. Does not compile for a key without a row.
template <class... Key>
constexpr std::array<const MethodSetting*, sizeof...(Key)> method_settings(Key... keys) {
  const auto row = [](std::string_view key) {
    for (const MethodSetting& setting : kMethodSettings)
      if (key == setting.key) return &setting;
    throw std::logic_error("no such setting");
  };
  return {row(keys)...};
}

}  // namespace pleat
