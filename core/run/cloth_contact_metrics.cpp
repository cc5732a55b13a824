#include "core/run/cloth_contact_metrics.h"

namespace pleat {

Json json_cloth_contact(const ClothContact& contact) {
  return {{"n_pairs", contact.n_pairs()},
          {"n_touching", contact.n_touching()},
          {"n_lists", contact.n_lists()},
          {"bytes", contact.bytes()},
          {"held_back_share", contact.held_back_share()},
          {"rms_motion_lost_m", contact.rms_loss()},
          {"n_blocked_substeps", contact.sums().n_blocked}};
}

}  // namespace pleat
