#include "core/run/plan_maker.h"

#include <catch2/catch.hpp>

#include "core/base/check.h"
#include "core/files/plan_file.h"
#include "native-tests/support/models.h"

namespace pleat {
namespace {

Scene swinging_canvas(int level = 2) {
  Scene scene = released_sheet_scene(4, "canvas");
  scene.level = level;
  scene.duration = 0.5;
  return scene;
}

PlanMaker finished(std::vector<Scene> examples, const PlanRecipe& recipe) {
  PlanMaker maker(std::move(examples), recipe);
  double last = -1;
  while (!maker.done()) {
    CHECK(maker.progress() >= last);
    last = maker.progress();
    maker.advance(1e-6);
  }
  CHECK(maker.progress() == 1);
  return maker;
}

}  // namespace

TEST_CASE("plan maker: the frames after the beginning are analysed, of every example", "[run]") {
  PlanRecipe recipe;
  recipe.begin = 0.2;  // frames of 1/30 s at 7/30, ... 15/30
  const int n_examples = GENERATE(1, 2);
  const PlanMaker maker =
      finished(std::vector<Scene>(static_cast<std::size_t>(n_examples), swinging_canvas()), recipe);
  CHECK(maker.cost().n_frames == 9 * n_examples);
  CHECK(maker.cost().megabytes == Approx(24e-6 * 17 * 17 * 9 * n_examples));
  CHECK(maker.plan().examples.size() == static_cast<std::size_t>(n_examples));
  CHECK(maker.plan().curvature_limits.size() > 3);
}

TEST_CASE("plan maker: from kept frames it plans as from a run of its own", "[run]") {
  PlanRecipe recipe;
  recipe.plan.criterion = GENERATE(PlanCriterion::shape, PlanCriterion::curvature);
  const PlanMaker maker = finished({swinging_canvas()}, recipe);
  CHECK(plan_text(maker.plan_for(recipe.plan)) == plan_text(maker.plan()));
  recipe.plan.demand = 0.5;
  recipe.plan.largest_loss = 0.0002;
  const PlanMaker other = finished({swinging_canvas()}, recipe);
  CHECK(plan_text(maker.plan_for(recipe.plan)) == plan_text(other.plan()));
  CHECK(other.plan().n_vertices > maker.plan().n_vertices);
}

TEST_CASE("plan maker: what is no example is refused", "[run]") {
  PlanRecipe recipe;
  CHECK_THROWS_AS(PlanMaker({swinging_canvas(0)}, recipe), InputError);
  CHECK_THROWS_AS(PlanMaker({swinging_canvas(1), swinging_canvas(2)}, recipe), InputError);
  recipe.begin = 0.48;  // one frame is left
  CHECK_THROWS_AS(PlanMaker({swinging_canvas()}, recipe), InputError);
}

}  // namespace pleat
