#pragma once

#include "core/base/vec.h"
#include "core/linalg/solve_report.h"
#include "core/linalg/sparse.h"

namespace pleat {

/// Solves A X = B for a symmetric positive definite A, given by its lower triangle.
///
/// Call `analyze` once per sparsity pattern, `factorize` once per set of values, `solve` as often
/// as wanted. None of the three allocates in our code when called again with the same pattern and
/// number of columns, but for cg's list that may grow with the values and what multigrid first
/// needs. Throws ContractError for calls in another order or sizes that disagree; numeric trouble
/// is reported.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;

  /// `lower` is compressed, without entries above the diagonal and with every diagonal entry.
  void analyze(const SparseMatrix& lower);

  /// `lower` has the pattern last analysed.
  SolveReport factorize(const SparseMatrix& lower);

  /// Sets the places of the vertices to which the unknowns belong, three each [m]: some solvers are
  /// faster for it. Of effect from the next factorisation on; sizes that differ count as not known.
  virtual void set_places(const VectorView& /*places*/) {}
  /// Sets the relative residual in (0, 1) at which an iterative solver stops from now on.
  virtual void set_tolerance(double /*tolerance*/) {}

  /// rhs       n x m right-hand sides
  /// solution  n x m; an iterative solver starts from what it holds, if that is better than zero
  SolveReport solve(const Eigen::Ref<const Eigen::MatrixXd>& rhs,
                    Eigen::Ref<Eigen::MatrixXd> solution);

 protected:
  /// Do the work once order and sizes are known to be right, n and m positive, and the entries of
  /// matrix and right-hand sides finite.
  virtual void do_analyze(const SparseMatrix& lower) = 0;
  virtual SolveReport do_factorize(const SparseMatrix& lower) = 0;
  virtual SolveReport do_solve(const Eigen::Ref<const Eigen::MatrixXd>& rhs,
                               Eigen::Ref<Eigen::MatrixXd> solution) = 0;

 private:
  Eigen::Index n_ = -1;  // -1 before the first analyze
  Eigen::Index n_entries_ = 0;
  bool factorized_ = false;
};

enum class SolverKind { cholmod, supernodal, eigen, cg, sor };
inline constexpr const char* kSolverNames[] = {"cholmod", "supernodal", "eigen", "cg", "sor"};

/// False for those that come nearer to the solution step by step.
bool is_direct(SolverKind kind);

const char* name(SolverKind kind);

/// Approximate inverse in cg.
enum class Preconditioner {
  automatic,          ///< an incomplete factor; multigrid where that turns out to take too long
  incomplete_factor,  ///< cheap, but the finer the mesh the less it helps
  multigrid,          ///< dear, and equally good on all meshes
};
inline constexpr const char* kPreconditionerNames[] = {"automatic", "incomplete_factor",
                                                       "multigrid"};

const char* name(Preconditioner preconditioner);

struct SolverOptions {
  /// cg, sor: relative residual |b - A x| / |b| at which to stop, in (0, 1)
  double tolerance = 1e-6;
  int max_iterations = 1000;  ///< cg, sor: cap, at least 1; reaching it is reported
  double omega = 0;           ///< sor: in (0, 2), or 0 for an estimate of the best
  Preconditioner preconditioner = Preconditioner::automatic;  ///< cg

  void validate() const;  ///< throws ContractError
};

}  // namespace pleat
