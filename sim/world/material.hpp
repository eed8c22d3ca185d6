#pragma once

namespace cosight::sim {

/// What a surface is made of; all are drawn from a seed.
enum class Material {
  kPlaster,    ///< painted wall: faint mottle, stains, scratches
  kConcrete,   ///< strong mottle at all scales
  kBrick,      ///< repeated, with bricks of different brightness
  kTiles,      ///< repeated, nearly equal: hard to tell apart
  kWallpaper,  ///< an exactly repeated ornament: cannot be told apart
  kCarpet,     ///< fine speckle
  kWood,       ///< planks with grain
  kPanels,     ///< ceiling panels with holes and lamps
  kFabric,     ///< clothes
  kBlank,      ///< nothing to hold on to
};

}  // namespace cosight::sim
