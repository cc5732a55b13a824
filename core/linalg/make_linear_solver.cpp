#include "core/linalg/make_linear_solver.h"

#include "core/base/check.h"
#include "core/linalg/direct/eigen_solver.h"
#include "core/linalg/direct/supernodal_solver.h"
#include "core/linalg/iterative/conjugate_gradient.h"
#include "core/linalg/iterative/successive_overrelaxation.h"
#ifdef PLEAT_HAS_CHOLMOD
#include "core/linalg/direct/cholmod_solver.h"
#endif

namespace pleat {

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

std::unique_ptr<LinearSolver> make_linear_solver(SolverKind kind, const SolverOptions& options) {
  options.validate();
  switch (kind) {
    case SolverKind::cholmod:
#ifdef PLEAT_HAS_CHOLMOD
      return make_cholmod_solver();
#else
      break;
#endif
    case SolverKind::supernodal:
      return make_supernodal_solver();
    case SolverKind::eigen:
      return make_eigen_solver();
    case SolverKind::cg:
      return make_conjugate_gradient(options);
    case SolverKind::sor:
      return make_successive_overrelaxation(options);
  }
  PLEAT_CHECK(false, "this solver is not part of this build");
  return nullptr;
}

}  // namespace pleat
