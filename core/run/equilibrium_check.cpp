#include "core/run/equilibrium_check.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/dynamics/implicit/best_translation.h"
#include "core/linalg/make_linear_solver.h"
#include "core/model/elasticity.h"
#include "core/model/hanging_vertices.h"

namespace pleat {
namespace {

constexpr double kSquaredStep = kEquilibriumStep * kEquilibriumStep;  // h^2 [s^2]
/// Relative residuals that one solve is asked for: no more than is worth solving for.
constexpr double kLeastTolerance = 1e-3;
constexpr double kLargestTolerance = 0.5;
constexpr int kSolverIterations = 200;
/// Share of the weight that may be left of the equations: a tenth of the bound that matters.
constexpr double kLeastResidual = 0.005;
constexpr int kMaxCorrections = 4;
/// Solves with other sets of contacts, at most.
constexpr int kMaxRounds = 10;
/// Change of the share from round to round that ends them.
constexpr double kShareAccuracy = 0.005;
/// Share that is far too large, whatever the contacts come to. Further rounds only say how large,
/// and may never end, one vertex slipping where another sticks.
constexpr double kFarTooLarge = 0.1;
/// Shares of the round before above which a share falls no longer.
constexpr double kSlowestFall = 0.8;
/// Rounds in which vertices that are new on a solid are held before they are judged.
constexpr int kRoundsOfNewContacts = 2;
/// Change of friction from round to round, in shares of it, that asks for another one.
constexpr double kFrictionAccuracy = 0.02;
/// A solid resists a vertex's moves by so many times what the cloth does: it gives way by a
/// hundredth.
constexpr double kFirmness = 100;
/// A solid that slides by faster than this rubs along its way; a slower one may hold [m/s].
constexpr double kSlowSolid = 0.05;
/// Solids whose normals have a lower cosine than this close on a vertex from both sides.
constexpr double kOpposed = -0.9;
/// Edges within so much of their limit may be held by it.
constexpr double kNearLimit = 0.98;

// Costs per vertex in units of StepperType::substep_cost, measured.
constexpr double kAnalysisCost = 90;
constexpr double kAssemblyCost = 18;
constexpr double kFactorCost = 14;
constexpr double kDirectCost = 300;
constexpr double kIterationCost = 2.7;
constexpr double kSolidCost = 0.5;

/// The part of a vector across a unit normal.
Vec3 across(const Vec3& vector, const Vec3& normal) { return vector - normal.dot(vector) * normal; }

double squared_sum(const Positions& columns, const std::vector<char>& counts) {
  double sum = 0;
  for (Eigen::Index i = 0; i < columns.cols(); ++i)
    if (counts[static_cast<std::size_t>(i)] != 0) sum += columns.col(i).squaredNorm();
  return sum;
}

/// Velocity with which a solid came to a place at a time [m/s]: its motion may end there.
Vec3 velocity_at(const Collider& collider, const Vec3& place, double time) {
  constexpr double kBefore = 1e-6;  // [s]
  if (collider.motion.kind == Motion::Kind::hold) return Vec3::Zero();
  return collider.motion.velocity(collider.motion.pose(time).inverse() * place, time - kBefore);
}

}  // namespace

EquilibriumCheck::EquilibriumCheck(const ClothModel& model)
    : model_(model),
      matrix_(model),
      forces_(3, model.n_vertices()),
      moves_(3, model.n_vertices()),
      correction_(3, model.n_vertices()),
      work_(0) {
  take_solver(SolverKind::cg);
}

void EquilibriumCheck::take_solver(SolverKind kind) {
  kind_ = kind;
  solver_ = make_linear_solver(kind, {kLeastTolerance, kSolverIterations});
  solver_->analyze(matrix_.lower());
  work_ += kAnalysisCost;
}

bool EquilibriumCheck::is_limited(const PositionsView& positions) const {
  if (!model_.strain_limit) return false;
  const StrainLimitOptions& options = model_.strain_limit->options;
  const auto is_held = [&](const GaugeEdge& edge) {
    const double by = strain(edge, positions);
    return by >= kNearLimit * options.stretch || by <= -kNearLimit * options.compression;
  };
  const std::vector<GaugeEdge>& edges = model_.strain_limit->edges;
  return std::any_of(edges.begin(), edges.end(), is_held);
}

void EquilibriumCheck::choose_free() {
  std::vector<VertexId> pinned;
  is_free_.assign(static_cast<std::size_t>(model_.n_vertices()), char{1});
  for (const Pin& pin : model_.pins) {
    is_free_[pin.vertex] = 0;
    pinned.push_back(pin.vertex);
  }
  for (const HangingVertex& hanging : model_.hanging) is_free_[hanging.vertex] = 0;
  matrix_.choose_prescribed(pinned);
  double mass = 0;
  double squared_mass = 0;
  for (int i = 0; i < model_.n_vertices(); ++i) {
    if (is_free_[static_cast<std::size_t>(i)] == 0) continue;
    mass += model_.masses[i];
    squared_mass += model_.masses[i] * model_.masses[i];
  }
  const double fall = kSquaredStep * model_.gravity.norm();
  weight_ = fall * mass;
  least_residual_ = kLeastResidual * fall * std::sqrt(squared_mass);
}

void EquilibriumCheck::set_forces(const State& state, double time) {
  forces_.setZero();
  add_internal_forces(model_, state.positions, state.velocities, forces_);
  add_gravity(model_, forces_);
  if (model_.air) {
    air_ = model_.air;
    air_->set_time(time);
    air_->add_forces(state.positions, state.velocities, model_.hanging, forces_);
  }
  forces_ *= kSquaredStep;
}

void EquilibriumCheck::set_matrix(const State& state) {
  matrix_.set_zero();
  matrix_.add_masses(1);
  matrix_.add_elasticity(state.positions, kSquaredStep, 0, ElementHessian::projected);
  matrix_.reduce_to_parents(flat(forces_));
  values_ = matrix_.lower();
  work_ += kAssemblyCost;
}

// A solid is held still against the cloth as a whole: what rides a belt is at rest on it. Only one
// that slides by fast is known to rub along its way.
void EquilibriumCheck::find_contacts(const State& state, double time) {
  contacts_.clear();
  if (!model_.contact) return;
  const double reach = kSquaredStep * model_.gravity.norm();
  const Vec3 drift = state.velocities * model_.masses / model_.masses.sum();
  const std::vector<Collider>& solids = model_.contact->colliders();
  for (const ContactPass::Support& near : model_.contact->supports(state.positions, time, reach)) {
    if (is_free_[near.vertex] == 0) continue;
    Contact contact{near.vertex, near.normal, near.friction,
                    -std::max(near.height, 0.0) * near.normal};
    const Vec3 past = velocity_at(solids[static_cast<std::size_t>(near.solid)],
                                  state.positions.col(near.vertex), time) -
                      drift;
    const Vec3 slide = across(past, near.normal);
    contact.may_stick = near.friction > 0 && slide.norm() <= kSlowSolid;
    if (!contact.may_stick) contact.target += kEquilibriumStep * slide;
    if (near.height <= kTouchDistance)
      contact.hold = contact.may_stick ? Contact::Hold::whole : Contact::Hold::along_normal;
    contact.resistance = kFirmness / 3 * matrix_.diagonal_trace(near.vertex);
    contact.depth = std::max(-near.height, 0.0);
    contacts_.push_back(contact);
  }
  press_from_both_sides();
  work_ += kSolidCost * static_cast<double>(solids.size());
}

// Solids that leave a vertex no room press on it from both sides: each would have it out of itself.
void EquilibriumCheck::press_from_both_sides() {
  if (model_.contact->colliders().size() < 2) return;
  std::vector<Contact*> known(static_cast<std::size_t>(model_.n_vertices()), nullptr);
  for (Contact& contact : contacts_) {
    Contact*& other = known[contact.vertex];
    if (other && contact.depth > 0 && other->normal.dot(contact.normal) < kOpposed) {
      other->target += other->depth * other->normal;
      contact.target += contact.depth * contact.normal;
    }
    if (contact.depth > 0) other = &contact;
  }
}

// Cloth counts as near that gravity would bring there within the step.
void EquilibriumCheck::choose_pairs(const State& state, double time,
                                    const ClothContact* cloth_contact) {
  pairs_.reset();
  if (cloth_contact == nullptr) return;
  pairs_.emplace(model_, *cloth_contact);
  pairs_->choose_at_rest(state, time, kEquilibriumStep);
  if (pairs_->fits(matrix_)) return;
  matrix_.join(pairs_->joins());
  solver_->analyze(matrix_.lower());
  work_ += kAnalysisCost;
}

// Solved again for what is left until that is little of the weight: stiff threads make a relative
// residual of theirs more than the whole weight.
bool EquilibriumCheck::solve() {
  matrix_.set_values(values_);
  rhs_ = forces_;
  for (const Contact& contact : contacts_) {
    auto force = rhs_.col(contact.vertex);
    force += contact.force;
    if (contact.hold == Contact::Hold::none) continue;
    const Mat3 resistance =
        contact.hold == Contact::Hold::whole
            ? Mat3(contact.resistance * Mat3::Identity())
            : Mat3(contact.resistance * contact.normal * contact.normal.transpose());
    matrix_.add_diagonal(contact.vertex, resistance);
    force += resistance * contact.target;
  }
  moves_.setZero();
  if (pairs_)
    PairHold::add(pairs_->held(), moves_, kEquilibriumStep, {1, kEquilibriumStep}, matrix_, rhs_);
  matrix_.prescribe(Positions::Zero(3, static_cast<Eigen::Index>(model_.pins.size())), flat(rhs_));
  work_ += is_direct(kind_) ? kDirectCost : kFactorCost;
  if (!solver_->factorize(matrix_.lower()).ok()) return false;
  const auto product = matrix_.lower().selfadjointView<Eigen::Lower>();
  const Positions whole = rhs_;
  for (int round = 0; round < kMaxCorrections; ++round) {
    const double asked = 0.9 * least_residual_ / std::sqrt(squared_sum(rhs_, is_free_));
    solver_->set_tolerance(std::max(kLeastTolerance, std::min(kLargestTolerance, asked)));
    correction_.setZero();
    const SolveReport report = solver_->solve(flat(rhs_), flat(correction_));
    work_ += kIterationCost * (report.iterations + 2);
    if (report.ends_run()) return false;
    moves_ += correction_;
    rhs_ = whole;
    flat(rhs_).noalias() -= product * flat(moves_);
    if (squared_sum(rhs_, is_free_) <= least_residual_ * least_residual_) {
      const Vec3 translation = best_translation(matrix_.lower(), whole, moves_, is_free_);
      for (int i = 0; i < model_.n_vertices(); ++i)
        if (is_free_[static_cast<std::size_t>(i)] != 0) moves_.col(i) += translation;
      return true;
    }
  }
  return false;
}

bool EquilibriumCheck::solve_by_factor() {
  if (is_direct(kind_)) return false;
  take_solver(SolverKind::supernodal);
  return solve();
}

// Takes what the solid gave in this round, p - r (dx - w): p the force of the round before, r the
// resistance, w the target. What of it lies in Coulomb's cone it may go on with. A vertex that is
// new on it is held first, to see with what force. Friction that would drive a vertex holds it.
void EquilibriumCheck::take_force(Contact& contact) const {
  using Hold = Contact::Hold;
  const Vec3& normal = contact.normal;
  const Vec3 past = moves_.col(contact.vertex) - contact.target;
  const Vec3 force = contact.force - contact.resistance * past;
  const double push = normal.dot(force);
  const Vec3 held_by = std::exchange(contact.force, Vec3(0, 0, 0));
  const Hold held = std::exchange(contact.hold, Hold::none);
  if (push <= 0) return;
  contact.hold = contact.may_stick ? Hold::whole : Hold::along_normal;
  if (held == Hold::none) return;
  const double most = contact.friction * push;
  const Vec3 rub = across(held == Hold::whole ? force : held_by, normal);
  const Vec3 slip = across(past, normal);
  const bool may_stick =
      contact.may_stick && (held == Hold::whole ? rub.norm() <= most : rub.dot(slip) > 0);
  contact.force = push * normal;
  if (may_stick) {
    contact.force += rub;
    return;
  }
  contact.hold = Hold::along_normal;
  const Vec3 way = held == Hold::whole ? rub : Vec3(-slip);
  if (most > 0 && !way.isZero(0)) contact.force += most * way.normalized();
}

bool EquilibriumCheck::take_contact_forces() {
  bool has_changed = false;
  for (Contact& contact : contacts_) {
    const Vec3 before = contact.force;
    const Contact::Hold held = contact.hold;
    take_force(contact);
    const Vec3 turned = across(contact.force - before, contact.normal);
    has_changed = has_changed || contact.hold != held ||
                  (held == Contact::Hold::along_normal &&
                   turned.norm() > kFrictionAccuracy * contact.force.norm());
  }
  return has_changed;
}

bool EquilibriumCheck::let_pairs_loose() {
  if (!pairs_) return false;
  correction_ = moves_ / kEquilibriumStep;
  return !pairs_->let_loose(correction_, kEquilibriumStep).empty();
}

double EquilibriumCheck::share_of_moves() const {
  double sum = 0;
  for (int i = 0; i < model_.n_vertices(); ++i)
    if (is_free_[static_cast<std::size_t>(i)] != 0) sum += model_.masses[i] * moves_.col(i).norm();
  return sum / weight_;
}

std::optional<double> EquilibriumCheck::unbalanced_share(const State& state, double time,
                                                         const ClothContact* cloth_contact) {
  choose_pairs(state, time, cloth_contact);
  choose_free();
  if (!(weight_ > 0) || is_limited(state.positions)) return std::nullopt;
  set_forces(state, time);
  set_matrix(state);
  solver_->set_places(flat(state.positions));
  if (pairs_) pairs_->set_resistances(matrix_, kFirmness);
  find_contacts(state, time);
  double share = 0;
  for (int round = 0; round < kMaxRounds; ++round) {
    const double before = share;
    if (!solve() && !solve_by_factor()) return std::nullopt;
    share = share_of_moves();
    const bool is_loose = let_pairs_loose();
    if (!take_contact_forces() && !is_loose) break;
    const bool is_known = round > 0 && std::abs(share - before) <= kShareAccuracy;
    const bool is_far_off =
        round >= kRoundsOfNewContacts && share > kFarTooLarge && share >= kSlowestFall * before;
    if (is_known || is_far_off) break;
  }
  return share;
}

}  // namespace pleat
