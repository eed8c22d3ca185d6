#include "robot_agent/inbox/wearer_session.hpp"

namespace cosight::inbox {

Admission WearerSession::admit(const PeerId& peer, Stamp now) {
  const bool is_other = wearer_ && *wearer_ != peer;
  if (is_other && !wearer_gone_ && now - last_heard_ < silence_) return Admission::kRefused;
  wearer_ = peer;
  last_heard_ = now;
  wearer_gone_ = false;
  return is_other ? Admission::kRestarted : Admission::kAccepted;
}

bool WearerSession::gone(const PeerId& peer) {
  if (wearer_ != peer) return false;
  wearer_gone_ = true;
  return true;
}

}  // namespace cosight::inbox
