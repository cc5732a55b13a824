#pragma once

#include <Eigen/Core>
#include <vector>

namespace pleat {

/// One row per vertex, as a solver takes three right-hand sides.
using VertexRows = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Places [m], or differences of places, and beside them what a constant matrix makes of them [N].
using LoadedRows = Eigen::Matrix<double, Eigen::Dynamic, 6>;

inline auto places(const LoadedRows& rows) { return rows.leftCols<3>(); }
inline auto places(LoadedRows& rows) { return rows.leftCols<3>(); }
inline auto loads(const LoadedRows& rows) { return rows.rightCols<3>(); }
inline auto loads(LoadedRows& rows) { return rows.rightCols<3>(); }

/// Foretells from the last rounds of an iteration where it leads. A round takes a point x to the
/// image g with A g = b(x), A symmetric and positive definite; the proposed point is the sum of
/// images, of weights that add up to 1, whose steps g - x nearly cancel in the norm of A. In this
/// norm the rounds are symmetric where x is near a minimum, so that two directions, each orthogonal
/// to those before it, stand for all rounds.
///
/// Loads are A times places: for images the right-hand side that was solved for, for sums of images
/// the sums of these, so that A is never multiplied with. Rows that do not take part have to
/// be the same in all points and images. Allocates nothing after it was made.
///
/// Sources: Anderson, Iterative procedures for nonlinear integral equations, Journal of the ACM
/// 1965. Peng, Deng, Zhang, Geng, Qin & Liu, Anderson acceleration for geometry optimization and
/// physics simulation, SIGGRAPH 2018. Wei, Bao & Liu, A class of short-term recurrence Anderson
/// mixing methods and their applications, ICLR 2022.
class AndersonAcceleration {
 public:
  explicit AndersonAcceleration(Eigen::Index n_vertices);

  /// Forgets all rounds. The next one starts at this point.
  ///
  /// rounding  norm of what rounding makes of loads [N]: steps of less foretell nothing
  void start(const LoadedRows& point, double rounding = 0);
  /// Proposes what to add to the image of the round that began at the present point, to be accepted
  /// or refused; null, and the image is the next point, while there is nothing to foretell from.
  /// Valid until the next call.
  const LoadedRows* propose(const VertexRows& image, const VertexRows& load);
  void accept() { point_ = image_ + change_; }
  /// The image is the next point, and rounds before this one are forgotten.
  void refuse();

  /// Count since this was made.
  int n_refused() const { return n_refused_; }

 private:
  /// The difference of two rounds, less its parts along earlier ones.
  struct Direction {
    LoadedRows step;
    LoadedRows image;
    double squared_norm = 0;  // norm of the step [J]
  };

  void add_direction();

  LoadedRows point_;
  LoadedRows step_;
  LoadedRows image_;
  LoadedRows change_;
  std::vector<Direction> directions_;  // the newest first; the last is room for the next
  std::size_t n_directions_ = 0;
  bool has_round_ = false;
  double rounding_ = 0;
  int n_refused_ = 0;
};

}  // namespace pleat
