#include "simulation/sph/neighbors/particle_tree.h"

#include "foundation/tasks/parallel_rows.h"
#include "simulation/sph/neighbors/morton.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fx::sim {

namespace {

constexpr uint32_t kChunk = 4096; ///< slots; leaves are cut in chunks so that it can be done in parallel
constexpr size_t kBoxPadding = 64;

size_t boxCapacity(size_t capacity)
{
    return capacity + capacity / 4 + kMaxTreeLevels * kBoxPadding;
}

uint32_t chunksOf(uint32_t count)
{
    return (count + kChunk - 1) / kChunk;
}

uint32_t padded(uint32_t boxes)
{
    return (boxes + 15u) / 16u * 16u;
}

} // namespace

template <class T>
ParticleTree<T>::ParticleTree(std::pmr::memory_resource* memory, uint32_t capacity)
    : sort_(memory, capacity), leafBegin_(memory, size_t(capacity) + 1),
      chunkLeaves_(memory, chunksOf(capacity)), reach_(memory, boxCapacity(capacity)),
      sizeAtSort_(memory, capacity), support_(memory, size_t(capacity) + kBoxPadding)
{
    for (uint32_t a = 0; a < 3; ++a) {
        low_[a] = base::Column<T>(memory, boxCapacity(capacity));
        high_[a] = base::Column<T>(memory, boxCapacity(capacity));
        position_[a] = base::Column<T>(memory, size_t(capacity) + kBoxPadding);
    }
}

template <class T>
void ParticleTree<T>::sort(const PointColumns<T>& points, const Domain& domain, base::TaskRunner& tasks)
{
    count_ = points.count;
    fresh_ = true;
    loosened_ = 0;
    sort_.sort({points.x, points.y, points.z}, count_, domain, tasks);
    cutLeaves(tasks);
    layOutLevels();
}

/// Every chunk of slots is cut alone, and the leaves of all chunks moved together then.
template <class T>
void ParticleTree<T>::cutLeaves(base::TaskRunner& tasks)
{
    const uint32_t chunks = chunksOf(count_);
    const auto spare = sort_.spare();
    parallelRows(tasks, chunks, 4, [&](uint32_t begin, uint32_t end) {
        for (uint32_t chunk = begin; chunk < end; ++chunk) {
            const uint32_t first = chunk * kChunk;
            chunkLeaves_[chunk] = cutChunk(first, std::min(count_, first + kChunk), spare.data() + first);
        }
    });
    uint32_t leaves = 0;
    for (uint32_t chunk = 0; chunk < chunks; ++chunk) {
        std::copy_n(spare.data() + chunk * kChunk, chunkLeaves_[chunk], leafBegin_.data() + leaves);
        leaves += chunkLeaves_[chunk];
    }
    leafBegin_[leaves] = count_;
    levelCount_[0] = leaves;
}

/// Cuts slots [begin, end) into the largest cells of the curve's tree that hold at most kMaxLeafParticles of
/// them, and what no cell can separate into runs of that length. @return the number of leaves
template <class T>
uint32_t ParticleTree<T>::cutChunk(uint32_t begin, uint32_t end, uint32_t* leaves) const
{
    const uint64_t* const keys = sort_.keys().data();
    uint32_t count = 0;
    for (uint32_t first = begin; first < end;) {
        leaves[count++] = first;
        // The cell that begins here is as large as the keys before and kMaxLeafParticles slots on allow.
        uint32_t size = first > begin ? differingBits(keys[first - 1], keys[first]) : kMortonBits + 1;
        const uint32_t most = std::min(first + kMaxLeafParticles, end);
        if (most < end)
            size = std::min(size, differingBits(keys[first], keys[most]));
        const uint64_t corner = keys[first];
        uint32_t next = first + 1;
        while (next < most && differingBits(corner, keys[next]) < std::max(size, 1u))
            ++next;
        first = next;
    }
    return count;
}

template <class T>
void ParticleTree<T>::layOutLevels()
{
    levels_ = count_ > 0 ? 1 : 0;
    levelFirst_[0] = 0;
    if (levels_ == 0)
        return;
    while (levelCount_[levels_ - 1] > 1) {
        levelFirst_[levels_] = levelFirst_[levels_ - 1] + padded(levelCount_[levels_ - 1]);
        levelCount_[levels_] = (levelCount_[levels_ - 1] + kTreeFanOut - 1) / kTreeFanOut;
        ++levels_;
    }
    for (uint32_t level = 0; level < levels_; ++level) {
        const uint32_t end = levelFirst_[level] + padded(levelCount_[level]);
        for (uint32_t box = levelFirst_[level] + levelCount_[level]; box < end; ++box) {
            for (uint32_t a = 0; a < 3; ++a) {
                low_[a][box] = std::numeric_limits<T>::infinity();
                high_[a][box] = -std::numeric_limits<T>::infinity();
            }
            reach_[box] = 0;
        }
    }
}

template <class T>
void ParticleTree<T>::fitLeaf(uint32_t leaf, const PointColumns<T>& sorted)
{
    const T* const axes[3] = {sorted.x, sorted.y, sorted.z};
    const uint32_t begin = leafBegin_[leaf];
    const uint32_t end = leafBegin_[leaf + 1];
    for (uint32_t a = 0; a < 3; ++a) {
        T low = std::numeric_limits<T>::infinity(); // so that NaN is passed over
        T high = -low;
        for (uint32_t slot = begin; slot < end; ++slot) {
            const T x = axes[a][slot];
            low = std::min(low, x);
            high = std::max(high, x);
            position_[a][slot] = x;
        }
        low_[a][leaf] = low;
        high_[a][leaf] = high;
    }
    T reach = 0;
    for (uint32_t slot = begin; slot < end; ++slot) {
        const T support = sorted.support[slot];
        reach = std::max(reach, support);
        support_[slot] = support;
    }
    reach_[leaf] = reach;
}

template <class T>
void ParticleTree<T>::fitNode(uint32_t level, uint32_t node)
{
    const uint32_t first = levelFirst_[level - 1] + node * kTreeFanOut;
    const uint32_t box = levelFirst_[level] + node;
    for (uint32_t a = 0; a < 3; ++a) {
        low_[a][box] = *std::min_element(low_[a].data() + first, low_[a].data() + first + kTreeFanOut);
        high_[a][box] = *std::max_element(high_[a].data() + first, high_[a].data() + first + kTreeFanOut);
    }
    reach_[box] = *std::max_element(reach_.data() + first, reach_.data() + first + kTreeFanOut);
}

template <class T>
void ParticleTree<T>::refit(const PointColumns<T>& sorted, base::TaskRunner& tasks)
{
    if (levels_ == 0)
        return;
    parallelRows(tasks, levelCount_[0], 256, [&](uint32_t begin, uint32_t end) {
        for (uint32_t leaf = begin; leaf < end; ++leaf)
            fitLeaf(leaf, sorted);
    });
    for (uint32_t level = 1; level < levels_; ++level)
        parallelRows(tasks, levelCount_[level], 256, [&](uint32_t begin, uint32_t end) {
            for (uint32_t node = begin; node < end; ++node)
                fitNode(level, node);
        });
    measureLoosening();
}

template <class T>
void ParticleTree<T>::measureLoosening()
{
    double sum = 0;
    for (uint32_t leaf = 0; leaf < levelCount_[0]; ++leaf) {
        T extent = 0;
        for (uint32_t a = 0; a < 3; ++a)
            extent += (high_[a][leaf] - low_[a][leaf]) / T(3);
        const T size = reach_[leaf] > 0 ? extent / reach_[leaf] + 2 : T(2);
        if (fresh_)
            sizeAtSort_[leaf] = size;
        const double growth = std::max(1.0, double(size) / double(sizeAtSort_[leaf]));
        sum += growth * growth * growth - 1.0;
    }
    loosened_ = fresh_ ? 0.0 : sum / double(levelCount_[0]);
    fresh_ = false;
}

template <class T>
TreeView<T> ParticleTree<T>::view() const
{
    TreeView<T> view;
    view.count = count_;
    view.levels = levels_;
    view.levelFirst = levelFirst_;
    view.levelCount = levelCount_;
    view.leafBegin = leafBegin_.data();
    for (uint32_t a = 0; a < 3; ++a) {
        view.low[a] = low_[a].data();
        view.high[a] = high_[a].data();
        view.position[a] = position_[a].data();
    }
    view.reach = reach_.data();
    view.support = support_.data();
    return view;
}

template class ParticleTree<float>;
template class ParticleTree<double>;

} // namespace fx::sim
