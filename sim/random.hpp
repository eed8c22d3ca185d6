#pragma once

#include <cstdint>
#include <string_view>

namespace cosight::sim {

/// Mixes 64 bits (splitmix64's finaliser): neighbouring inputs give unrelated outputs.
std::uint64_t mix_bits(std::uint64_t bits);

/// Random numbers that depend on nothing but the run's seed, what they are for, and which one it is (a frame,
/// a wall): any part of the world can be made in any order, on any thread, and comes out the same.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view purpose, std::uint64_t index = 0);

  std::uint64_t bits();
  double uniform();                         ///< [0, 1)
  double uniform(double low, double high);  ///< [low, high)
  double normal();                          ///< mean 0, standard deviation 1
  int below(int count);                     ///< 0 … count - 1
  bool chance(double probability) { return uniform() < probability; }

 private:
  std::uint64_t state_;
};

}  // namespace cosight::sim
