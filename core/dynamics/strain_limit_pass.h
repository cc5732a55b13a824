#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/contact/contact_pass.h"
#include "core/model/cloth_model.h"
#include "core/model/hanging_vertices.h"
#include "core/model/state.h"

namespace pleat {

/// Keeps the edges of a cloth within its model's limits, in the state that a substep proposes.
///
/// An edge that would end longer than (1 + tau) L gets an impulse along itself, equal and opposite
/// at its ends and shared by their inverse masses, after which it ends just below the limit. Edges
/// of a line are solved for together, by one tridiagonal system; sweeps over all lines go on until
/// no edge exceeds. An edge may give impulse back within a substep, never more than it got. Linear
/// momentum is kept; angular momentum is lost in first order of the substep, as impulses act along
/// the edge as it ends: along where it began they would make taut cloth flutter. Ends that hang
/// hand impulses on to their parents.
///
/// Source: the velocity constraint of Sun, Zhao & Liu, Computer Engineering and Applications
/// 44(31), 2008; docs/methods/strain_limit.md.
class StrainLimitPass {
 public:
  /// model  with a strain limit; outlives the pass
  explicit StrainLimitPass(const ClothModel& model);

  /// Corrects what a stepper proposes for the end of a substep, in which a change of velocity by dv
  /// moves a vertex by travel dv [s]. Pinned vertices stay. Allocates nothing.
  void limit(State& state, double travel);

  /// Corrects once more in that substep, after contact touched vertices, which are then not pulled
  /// into solids.
  void limit_again(State& state, double travel, std::span<const ContactPass::Touch> touches);

  /// True where an edge that is not pinned at both ends is beyond its limits.
  bool is_exceeded(const PositionsView& positions) const;

  std::int64_t n_sweeps() const {
    return n_sweeps_;
  }  ///< sweeps over all edges, since construction
  /// Calls that ended with an edge beyond its limits for want of sweeps, since construction.
  std::int64_t n_capped() const { return n_capped_; }

 private:
  /// The ends of an edge, both free to move.
  struct Ends {
    VertexId a, b;

    Vec3 difference(const PositionsView& positions) const {
      return positions.col(a) - positions.col(b);
    }
    template <class Visit>
    void for_each(Visit&& visit) const {
      visit(a, 1.0);
      visit(b, -1.0);
    }
  };
  /// The vertices that move an edge of which an end hangs.
  struct SharedEnds {
    Combination sum;

    Vec3 difference(const PositionsView& positions) const;
    template <class Visit>
    void for_each(Visit&& visit) const {
      for (std::size_t i = 0; i < sum.n_terms; ++i) visit(sum.terms[i].vertex, sum.terms[i].factor);
    }
  };
  template <class EndsKind>
  struct Edge {
    EndsKind ends;
    double rest_length;  // [m]
    double impulse =
        0;  // this substep's, times the travel it makes: pulls the ends together [kg m]
    bool was_active = false;  // had an impulse at the end of the last substep
  };
  struct Line {
    std::size_t begin, end;  // range of its edges in edges_
  };
  /// The demand of an edge where the sweeps have come to.
  struct Demand {
    bool is_active = false;   // its impulse may change
    bool is_spent = false;    // it gave all of its impulse back
    bool pulls = false;       // never pushes, or the other way round
    double length = 0;        // [m]
    double shortening = 0;    // wanted [m]
    Vec3 direction{0, 0, 0};  // unit, from b to a
    double inverse_mass = 0;  // inverse mass against an impulse [1/kg]
    double coupling = 0;      // coupling with the next edge of the line [1/kg]
    double after = 0;    // share of the next edge's impulse in this one, once that is eliminated
    double impulse = 0;  // change of it [kg m]
  };
  /// A vertex of a line on the way to its end.
  struct LineEnd {
    Vec3 place{0, 0, 0};  // [m]
    double pull = 0;      // pull on the next vertex, over the length of the edge to it [kg]
    double next = 0;      // share of the next vertex's place, once this one is eliminated
  };
  struct Range {
    double shortest, longest;  // shares of a rest length
  };

  void set_inverse_masses();
  template <class EndsKind>
  double inverse_mass(const EndsKind& ends) const;
  template <class EndsKind>
  bool exceeds(const Edge<EndsKind>& edge, double squared_length) const;
  template <class EndsKind>
  bool is_beyond(const Edge<EndsKind>& edge, const PositionsView& positions) const;
  template <class EndsKind>
  void pull(const EndsKind& ends, const Vec3& impulse, Positions& positions) const;
  template <class EndsKind>
  Demand demand_of(const Edge<EndsKind>& edge, const Positions& positions) const;
  bool correct(const Line& line, Positions& positions);
  void demand(const Line& line, const Positions& positions);
  void leave_overstretched(const Line& line, const Positions& positions);
  void eliminate(const Line& line, double diagonal_factor);
  bool change_active(const Line& line);
  bool pushes(const Line& line) const;
  void place_ends(const Line& line, Positions& positions);
  double diagonal_factor(const Line& line) const;
  template <class EndsKind>
  bool correct(Edge<EndsKind>& edge, Positions& positions);
  template <class EndsKind>
  static double impulse_after(const Edge<EndsKind>& edge, const Demand& demand);
  template <class EndsKind>
  void apply(Edge<EndsKind>& edge, const Demand& demand, Positions& positions) const;
  bool sweep(Positions& positions);
  void sweep_until_within(State& state, double travel);
  double largest_excess(const Positions& positions) const;
  double share_of_least_energy(const Positions& velocities) const;

  const ClothModel& model_;
  StrainLimitOptions options_;
  Range limits_;  // an edge exceeds beyond them
  Range goals_;   // just inside, where an edge that exceeds is put
  std::vector<Edge<Ends>> edges_;
  std::vector<Line> lines_;
  std::vector<Edge<SharedEnds>> shared_edges_;
  std::vector<Demand> demands_;     // one for each edge of a line
  std::vector<LineEnd> line_ends_;  // one for each vertex of a line
  Eigen::VectorXd inverse_masses_;  // 0 where a vertex is pinned or hangs [1/kg]
  Positions proposed_;  // places before the sweeps [m], and then what they add to velocities
  Positions normals_;   // normals of solids that touch a vertex, else zero; empty without contact
  bool is_touched_ = false;
  bool is_first_sweep_ = false;
  std::int64_t n_sweeps_ = 0;
  std::int64_t n_capped_ = 0;
};

}  // namespace pleat
