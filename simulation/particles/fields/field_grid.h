/// @file field_grid.h
/// Values on the nodes of a regular grid, from files: densities, heights and velocities.
///
/// A file `*.fxgrid` is a text header followed by binary numbers:
///     fxgrid 1
///     nodes NX NY NZ      1..4096 each, at most 2^24 together
///     channels C          1 or 3 numbers per node
///     low X Y Z           [m] the first node
///     cell X Y Z          [m] distance between neighboring nodes, > 0
///     data                followed by a line feed
///     NX * NY * NZ * C binary32 numbers, little endian; channels vary fastest, then x, y, z
/// The lines of the header have this order. Each line ends with a line feed. Spaces separate the words of a
/// line.
///
/// @formula trilinear-vectors
/// Values between the nodes of a grid by trilinear interpolation.
///
/// symbol   unit   meaning
///   p        m      position
///   o, h     m      first node and distance of nodes, along each axis
///   g        1      position in cells
///   u        1      position within the cell, 0..1
///   fi, wi   any, 1 numbers at the eight corners and their weights
/// @derivation
///   g = (p - o) / h, the cell is floor(g), at most the last one; u = g - floor(g)           (1)
///   wi is the product of u or 1 - u over the axes; f = sum of wi fi                         (2)
/// @source    elementary
/// @deviation none
/// @valid     0 <= g <= n - 1 on each axis; an axis of one node has no extent and is constant
/// @accuracy  fields that are linear in space are reproduced within float rounding
/// @tests     tests/simulation/particles/modules/test_field_grid.cpp
#pragma once

#include "foundation/math/geometry.h"
#include "foundation/result/status.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace fx::sim {

constexpr uint32_t kMaxGridNodesPerAxis = 4096;
constexpr size_t kMaxGridNodes = size_t(1) << 24;
constexpr uint64_t kMaxGridBytes = uint64_t(kMaxGridNodes) * 12 + 1024; ///< [byte] maximum size of a file

/// A regular grid of numbers or vectors. A grid must not change after it is shared between threads. [any
/// thread]
struct FieldGrid
{
    glm::uvec3 nodes{1u};
    uint32_t channels = 1;
    glm::vec3 low{0.0f};  ///< [m] first node
    glm::vec3 cell{1.0f}; ///< [m] > 0
    std::vector<float> values;

    size_t count() const { return size_t(nodes.x) * nodes.y * nodes.z; }
    size_t index(uint32_t x, uint32_t y, uint32_t z) const
    {
        return channels * (x + size_t(nodes.x) * (y + size_t(nodes.y) * z));
    }
    glm::vec3 high() const { return low + cell * glm::vec3(nodes - 1u); } ///< [m] last node
};

/// Parses the bytes of a grid file. @return Parse (with the byte offset), TooLarge, InvalidArgument (a number
/// is not finite)
base::Result<std::shared_ptr<const FieldGrid>> parseFieldGrid(std::string_view bytes);

/// Formats a grid as the bytes of a file that parseFieldGrid() reads.
std::string writeFieldGrid(const FieldGrid& grid);

} // namespace fx::sim
