#include "core/linalg/linear_solver.h"

#include "core/base/check.h"
#include "core/linalg/conjugate_gradient.h"
#include "core/linalg/eigen_solver.h"
#ifdef PLEAT_HAS_CHOLMOD
#include "core/linalg/cholmod_solver.h"
#endif

namespace pleat {

const char* name(SolverKind kind) {
  switch (kind) {
    case SolverKind::cholmod:
      return "cholmod";
    case SolverKind::eigen:
      return "eigen";
    case SolverKind::cg:
      return "cg";
  }
  return "";
}

void SolverOptions::validate() const {
  PLEAT_CHECK(tolerance > 0 && tolerance < 1, "the solver's tolerance must lie in (0, 1)");
  PLEAT_CHECK(max_iterations >= 1, "the solver's iteration cap must be at least 1");
}

bool is_available(SolverKind kind) {
#ifdef PLEAT_HAS_CHOLMOD
  static_cast<void>(kind);
  return true;
#else
  return kind != SolverKind::cholmod;
#endif
}

SolverKind best_direct_solver() {
  return is_available(SolverKind::cholmod) ? SolverKind::cholmod : SolverKind::eigen;
}

std::unique_ptr<LinearSolver> make_linear_solver(SolverKind kind, int block_size,
                                                 const SolverOptions& options) {
  PLEAT_CHECK(block_size == 1 || block_size == 3, "the block size must be 1 or 3");
  options.validate();
  switch (kind) {
    case SolverKind::cholmod:
#ifdef PLEAT_HAS_CHOLMOD
      return make_cholmod_solver();
#else
      break;
#endif
    case SolverKind::eigen:
      return make_eigen_solver();
    case SolverKind::cg:
      return make_conjugate_gradient(block_size, options);
  }
  PLEAT_CHECK(false, "this solver is not part of this build");
  return nullptr;
}

}  // namespace pleat
