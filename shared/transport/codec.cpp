#include "shared/transport/codec.hpp"

namespace cosight::transport {

const char* to_string(Fault fault) {
  switch (fault) {
    case Fault::kNone:
      return "no fault";
    case Fault::kTooLarge:
      return "larger than the topic allows";
    case Fault::kMalformed:
      return "not the CDR of this topic's type";
    case Fault::kStamp:
      return "stamp out of range";
    case Fault::kNotFinite:
      return "NaN or infinity";
    case Fault::kRotation:
      return "orientation unknown or not a unit quaternion";
    case Fault::kCovariance:
      return "covariance not symmetric and positive semidefinite";
    case Fault::kDimensions:
      return "dimensions out of range";
    case Fault::kSize:
      return "number of bytes does not fit the dimensions";
    case Fault::kEncoding:
      return "unknown encoding";
    case Fault::kDistortion:
      return "unknown distortion model or wrong number of coefficients";
    case Fault::kUnsupportedCamera:
      return "skew, binning or region of interest is not supported";
    case Fault::kText:
      return "text too long or not printable";
  }
  return "?";
}

}  // namespace cosight::transport
