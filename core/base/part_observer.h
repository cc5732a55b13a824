#pragma once

#include <cstddef>

namespace pleat {

/// The parts of a computation that can be timed from outside.
enum class Part {
  convert,   ///< conversion between the shared state and a stepper's own layout
  forces,    ///< forces and right-hand side
  assembly,  ///< matrix values
  factor,    ///< numeric factorisation
  solve,     ///< linear solve or constraint projection
  contact,
  strain_limit,
  cloth_contact,
};
inline constexpr const char* kPartNames[] = {"convert", "forces",  "assembly",     "factor",
                                             "solve",   "contact", "strain limit", "cloth contact"};
constexpr int kPartCount = 8;

constexpr const char* name(Part part) { return kPartNames[static_cast<std::size_t>(part)]; }

/// Told where a computation is. Nothing below `run` reads a clock.
class PartObserver {
 public:
  virtual ~PartObserver() = default;
  virtual void begin(Part part) = 0;
  virtual void end(Part part) = 0;
};

/// Marks a part for the length of a scope; costs one branch without an observer.
class PartScope {
 public:
  PartScope(PartObserver* observer, Part part) : observer_(observer), part_(part) {
    if (observer_) observer_->begin(part_);
  }
  ~PartScope() {
    if (observer_) observer_->end(part_);
  }
  PartScope(const PartScope&) = delete;
  PartScope& operator=(const PartScope&) = delete;

 private:
  PartObserver* observer_;
  Part part_;
};

}  // namespace pleat
