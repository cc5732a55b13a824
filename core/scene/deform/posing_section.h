#pragma once

#include "core/body/moving_body.h"
#include "core/files/file_source.h"
#include "core/files/json_reader.h"

namespace pleat {

/// A body that wears a cloth: in one posture it fits the cloth at rest, in another it shows it.
/// All is seen from the bone that the cloth is pinned to, which stays.
class Posing {
 public:
  /// A posture that a motion comes through.
  struct Moment {
    BodyMotion motion;
    double time = 0;  ///< time since the body stood [s]
  };

  /// facing  where the body looks in the cloth's axes: level, of length one; y is up
  Posing(const Moment& at_rest, const Moment& posed, Bone pinned, const Vec3& facing);

  /// The motion of the cloth at a bone from rest to the posture, in the cloth's axes.
  Pose of(Bone bone) const;

 private:
  MovingBody at_rest_, posed_;
  double time_at_rest_, time_posed_;  // [s]
  Bone pinned_;
  Pose facing_;  // pose of the body's axes in the cloth's
};

/// The section "figure" of a deformation. Throws InputError with the JSON pointer.
Posing read_posing(const JsonReader& reader, const FileSource& files);

}  // namespace pleat
