/// @file particle_tree.h
/// Particles sorted along a Morton curve, with a tree of bounding boxes over them.
#pragma once

#include "foundation/memory/column.h"
#include "foundation/tasks/task_runner.h"
#include "simulation/sph/neighbors/domain.h"
#include "simulation/sph/neighbors/morton_sort.h"

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>

namespace fx::sim {

/// Positions and supports of particles. Arrays of `count` elements.
template <class T>
struct PointColumns
{
    const T* x;       ///< [m] finite
    const T* y;       ///< [m]
    const T* z;       ///< [m]
    const T* support; ///< [m] radius of the kernel's support, > 0
    uint32_t count;
};

constexpr uint32_t kTreeFanOut = 8;        ///< number of children of a node
constexpr uint32_t kMaxTreeLevels = 11;    ///< maximum number of levels, for up to 8^10 leaves
constexpr uint32_t kMaxLeafParticles = 16; ///< maximum number of particles of a leaf

/// Read access to a tree for searches. Level 0 consists of the leaves: leaf k holds the slots leafBegin[k] ..
/// leafBegin[k + 1] - 1. Box k of level l + 1 covers the boxes 8 k .. 8 k + 7 of level l; the last level has
/// one box. The boxes of level l are numbered from levelFirst[l]. Each level is padded with empty boxes,
/// which no query touches, so that eight children can always be read.
template <class T>
struct TreeView
{
    uint32_t count = 0;  ///< number of particles
    uint32_t levels = 0; ///< number of levels; 0 for an empty tree
    std::array<uint32_t, kMaxTreeLevels> levelFirst{};
    std::array<uint32_t, kMaxTreeLevels> levelCount{};
    const uint32_t* leafBegin = nullptr;
    std::array<const T*, 3> low{};      ///< [m] lower corners of boxes
    std::array<const T*, 3> high{};     ///< [m]
    const T* reach = nullptr;           ///< [m] largest support inside a box
    std::array<const T*, 3> position{}; ///< [m] positions of particles at the last refit
    const T* support = nullptr;         ///< [m]
};

/// Tree over particles sorted along a Morton curve of 64-bit keys. A leaf is the largest cell of the curve's
/// binary tree with at most kMaxLeafParticles particles. Eight consecutive leaves share a box, and eight
/// consecutive boxes share a box of the next level. Therefore no pointers are needed, and eight children are
/// tested at once. The capacity determines the memory: 92 bytes per particle in float, 147 bytes in double.
template <class T>
class ParticleTree
{
public:
    ParticleTree(std::pmr::memory_resource* memory, uint32_t capacity);

    /// Computes the order of the particles and the cells of the tree. order()[slot] is the index in `points`
    /// of the particle at `slot`. The caller reorders its columns accordingly and then calls refit. Particles
    /// with equal keys are ordered by index. Therefore the order is the same for any number of workers.
    /// Particles at NaN are allowed and have no neighbors.
    void sort(const PointColumns<T>& points, const Domain& domain, base::TaskRunner& tasks);
    std::span<const uint32_t> order() const { return sort_.order(); }

    /// Recomputes the bounds and the largest supports of all cells. The columns must be in tree order, and
    /// are copied. Must be called whenever particles have moved. Searches are correct for any motion, but
    /// become slower. If loosened() exceeds 0.25, sorting costs less than the slower searches.
    void refit(const PointColumns<T>& sorted, base::TaskRunner& tasks);
    /// [1] Growth of the search volume since the first refit after the last sort. The search volume is the
    /// mean volume of a search from a leaf, in units of the cube of the leaf's largest support. With a growth
    /// of 1, searches test about twice as many particles. A uniform expansion of all particles gives a growth
    /// of 0.
    double loosened() const { return loosened_; }

    TreeView<T> view() const;

private:
    void cutLeaves(base::TaskRunner& tasks);
    uint32_t cutChunk(uint32_t begin, uint32_t end, uint32_t* leaves) const;
    void layOutLevels();
    void fitLeaf(uint32_t leaf, const PointColumns<T>& sorted);
    void fitNode(uint32_t level, uint32_t node);
    void measureLoosening();

    uint32_t count_ = 0;
    bool fresh_ = true; ///< true: the tree was sorted and not yet refitted
    double loosened_ = 0;
    uint32_t levels_ = 0;
    std::array<uint32_t, kMaxTreeLevels> levelFirst_{};
    std::array<uint32_t, kMaxTreeLevels> levelCount_{};
    MortonSort<T> sort_;
    base::Column<uint32_t> leafBegin_;
    base::Column<uint32_t> chunkLeaves_; ///< number of leaves of each chunk of slots
    std::array<base::Column<T>, 3> low_;
    std::array<base::Column<T>, 3> high_;
    base::Column<T> reach_;
    /// [1] Width of the search box of a leaf divided by the leaf's largest support, after the last sort.
    base::Column<T> sizeAtSort_;
    std::array<base::Column<T>, 3> position_;
    base::Column<T> support_;
};

extern template class ParticleTree<float>;
extern template class ParticleTree<double>;

} // namespace fx::sim
