/// @file mesh_sampler.h
/// Random positions on triangles and in grids, with probabilities proportional to area and density.
///
/// @formula mesh-and-volume-samples
/// Uniform samples of a surface, and samples of a volume in proportion to its density.
///
/// symbol   unit   meaning
///   a, b, c  m      corners of the selected triangle
///   s, t     1      uniform numbers
///   i        1      selected node
///   h        m      distance between nodes
/// @derivation
///   A triangle is selected with a probability proportional to its area. The position in it is uniform, due
///   to the square root:  p = a + r (1 - t) (b - a) + r t (c - a), r = s^(1/2)                    (1)
///   A node is selected in proportion to its density, which fills the box of size h around the node:
///   p = node i + h (s - 1/2, t - 1/2, v - 1/2)                                                (2)
/// @source    elementary; the selection is by alias-method
/// @deviation none
/// @valid     at least one triangle with an area, one node with a density; negative densities count as 0
/// @accuracy  float rounding
/// @tests     tests/simulation/particles/modules/test_shapes.cpp
#pragma once

#include "foundation/result/status.h"
#include "simulation/collision/triangle_mesh.h"
#include "simulation/particles/fields/alias_table.h"
#include "simulation/particles/fields/field_grid.h"

#include <glm/vec3.hpp>

#include <memory>
#include <vector>

namespace fx::sim {

struct MeshSampler
{
    struct Triangle
    {
        glm::vec3 corner;  ///< [m] corner a
        glm::vec3 side[2]; ///< [m] edges b - a and c - a
        glm::vec3 normal;  ///< unit vector
    };
    std::vector<Triangle> triangles;
    AliasTable table;
};

struct VolumeSampler
{
    glm::vec3 low{0.0f};  ///< [m] position of the first node
    glm::vec3 cell{1.0f}; ///< [m]
    /// [1] positions of the nodes with a density above 0, in cells from the first node
    std::vector<glm::vec3> nodes;
    AliasTable table;
};

/// Prepares sampling of the triangles of a mesh.
/// @return the error of checkMesh(), or InvalidArgument if all triangles have zero area
base::Result<std::shared_ptr<const MeshSampler>> makeMeshSampler(const TriangleMesh& mesh);
/// Prepares sampling of a density.
/// @return InvalidArgument if the grid does not have one channel, or has no density above 0
base::Result<std::shared_ptr<const VolumeSampler>> makeVolumeSampler(const FieldGrid& density);

} // namespace fx::sim
