#pragma once

#include "core/modal/modal_body.h"

namespace pleat {

/// Fills in the motion between key shapes: the shape in the middle of two neighbours becomes a new
/// neighbour of both, until there are enough. Each part of a surface is a body of its own.
class KeyCompletion {
 public:
  /// keys  surfaces with the same vertices, two or more, each vertex in a triangle [m]
  ///
  /// Throws InputError for keys of different vertices, fewer than two, places that are not finite,
  /// and where no volume can carry a key.
  KeyCompletion(const std::vector<Positions>& keys, const std::vector<Triangle>& triangles,
                const ModalOptions& options);

  struct Frame {
    double time;           ///< the first key is at 0, the next at 1
    int left;              ///< the key at its time or the last one before
    double share_of_next;  ///< share of the time to the next key, in [0, 1)
    std::vector<ModalBody::Shape> bodies;

    bool is_key() const { return share_of_next == 0; }
    /// |D(a -> x) - D(b -> x)| over the larger one, of all bodies; 0 for a key.
    double unequal_halves() const;
  };

  int n_keys() const { return bodies_.front().n_keys(); }
  const std::vector<ModalBody>& bodies() const { return bodies_; }

  /// Every second time between keys that are farther apart than others is filled first. At least
  /// the keys.
  std::vector<Frame> frames(int count) const;
  /// Fills in frames until no vertex moves farther from one to the next than `step` [m], or there
  /// are `most` of them.
  std::vector<Frame> frames_by_step(double step, int most) const;

  Positions surface(const Frame& frame) const;
  /// Another surface for a key; modes and space stay.
  SolveReport replace_key(int index, const Positions& surface);

 private:
  std::vector<Frame> key_frames() const;
  Frame middle(const Frame& a, const Frame& b) const;

  std::vector<std::vector<VertexId>> vertices_;  // vertices of each body
  std::vector<ModalBody> bodies_;
  Eigen::Index n_vertices_;
};

}  // namespace pleat
