#include "core/dynamics/method_settings.h"

#include <catch2/catch.hpp>
#include <string>
#include <utility>
#include <vector>

namespace pleat {
namespace {

/// The words of a setting with what they stand for, in the order in which a refusal lists them.
template <class Value>
void check_words(const char* key, Value MethodOptions::*member,
                 const std::vector<std::pair<std::string, Value>>& expected) {
  CAPTURE(key);
  const auto& field = std::get<WordField>(method_settings(key)[0]->field);
  REQUIRE(field.words.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto& [word, value] = expected[i];
    CHECK(field.words[i] == word);
    MethodOptions method;
    field.set(method, i);
    CHECK(method.*member == value);
    CHECK(field.word(method) == word);
  }
}

}  // namespace

TEST_CASE("method settings: words stand for the values of their names", "[dynamics]") {
  check_words("solver", &MethodOptions::solver,
              {{"cholmod", SolverKind::cholmod},
               {"supernodal", SolverKind::supernodal},
               {"eigen", SolverKind::eigen},
               {"cg", SolverKind::cg},
               {"sor", SolverKind::sor}});
  check_words("preconditioner", &MethodOptions::preconditioner,
              {{"automatic", Preconditioner::automatic},
               {"incomplete_factor", Preconditioner::incomplete_factor},
               {"multigrid", Preconditioner::multigrid}});
  check_words(
      "split", &MethodOptions::split,
      {{"by_stability", ImplicitSplit::by_stability}, {"structural", ImplicitSplit::structural}});
  check_words("rule", &MethodOptions::rule,
              {{"backward_euler", NewtonRule::backward_euler},
               {"midpoint", NewtonRule::midpoint},
               {"equilibrium", NewtonRule::equilibrium}});
  check_words("acceleration", &MethodOptions::acceleration,
              {{"none", Acceleration::none}, {"anderson", Acceleration::anderson}});
  check_words("euler", &MethodOptions::euler,
              {{"symplectic", EulerRule::symplectic}, {"forward", EulerRule::forward}});
  check_words("beyond_bound", &MethodOptions::beyond_bound,
              {{"refuse", BeyondBound::refuse}, {"go_on", BeyondBound::go_on}});
  check_words("level_lengths", &MethodOptions::level_lengths,
              {{"surface", LevelLengths::surface},
               {"chord", LevelLengths::chord},
               {"error", LevelLengths::error}});
  const std::vector<std::pair<std::string, Smoother>> smoothers = {
      {"none", Smoother::none},
      {"jacobi", Smoother::jacobi},
      {"gauss_seidel", Smoother::gauss_seidel},
      {"lines", Smoother::lines},
      {"sor", Smoother::sor}};
  check_words("smoother_before", &MethodOptions::smoother_before, smoothers);
  check_words("smoother", &MethodOptions::smoother_after, smoothers);
  check_words("attachments", &MethodOptions::attachments,
              {{"none", Attachments::none}, {"long_range", Attachments::long_range}});
  check_words("constraints", &MethodOptions::constraints,
              {{"compliant", Constraints::compliant}, {"rigid", Constraints::rigid}});
}

TEST_CASE("method settings: each word that the page offers has a title", "[dynamics]") {
  for (const MethodSetting& setting : kMethodSettings) {
    CAPTURE(setting.key);
    const auto* field = std::get_if<WordField>(&setting.field);
    if (field != nullptr && setting.title != nullptr)
      CHECK(field->titles.size() == field->words.size());
  }
}

}  // namespace pleat
