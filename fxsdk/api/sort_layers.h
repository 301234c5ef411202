/// @file sort_layers.h
/// The snapshots of a frame, divided into the layers of their instances.
#pragma once

#include "foundation/snapshot/filtered_snapshot.h"
#include "foundation/snapshot/snapshot_ring.h"
#include "fxsdk/scene/display_rules.h"

#include <array>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

namespace fx::api {

/// A layer of a frame, with the instances of this layer only.
struct SortLayer
{
    int32_t number;
    base::SnapshotPair snapshots;
};

/// Threads: [GL thread].
class SortLayers
{
public:
    explicit SortLayers(std::pmr::memory_resource* memory)
        : memory_(memory), rules_(memory), kept_(memory), layers_(memory), places_(memory), groups_(memory)
    {}

    /// Divides the snapshots of a frame. Copies stay valid until the next call, and are reused while snapshot
    /// and rules are the same.
    void divide(const base::SnapshotPair& shown, const scene::DisplayRules& rules);
    /// Layers in the order in which they are drawn. Empty: all instances are in one layer without an order of
    /// their own, so that the snapshots are drawn as they are.
    std::span<const SortLayer> layers() const { return layers_; }
    /// Forgets the rules and copies of the last scene.
    void forget();

private:
    struct Copy
    {
        std::unique_ptr<base::FrameSnapshot> snapshot;
        uint64_t serial = 0; ///< FrameSnapshot::serial() of the original; 0: none
    };
    struct KeptLayer
    {
        int32_t number;
        std::array<Copy, 2> copies;
    };
    /// Place of a group in the order of drawing.
    struct Place
    {
        int32_t layer;
        int32_t sortKey;
        uint32_t group;
    };

    scene::DisplayRule ruleOf(uint64_t instance) const;
    void addPlaces(const base::FrameSnapshot* snapshot);
    bool isPlain() const;
    KeptLayer& keptLayer(int32_t number);
    const base::FrameSnapshot* copyOf(const base::FrameSnapshot* all, uint64_t otherSerial, KeptLayer& layer);

    std::pmr::memory_resource* memory_;
    std::pmr::vector<scene::InstanceRule> rules_;
    uint64_t revision_ = 0; ///< of rules_
    bool hasOrder_ = false; ///< a rule has a layer or a sort key
    std::pmr::vector<KeptLayer> kept_;
    std::pmr::vector<SortLayer> layers_;
    std::pmr::vector<Place> places_; ///< scratch
    std::pmr::vector<uint32_t> groups_;
};

} // namespace fx::api
