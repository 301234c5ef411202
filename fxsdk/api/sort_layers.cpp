#include "fxsdk/api/sort_layers.h"

#include <algorithm>
#include <utility>

namespace fx::api {

void SortLayers::forget()
{
    revision_ = 0;
    hasOrder_ = false;
    layers_.clear();
    kept_.clear();
}

scene::DisplayRule SortLayers::ruleOf(uint64_t instance) const
{
    const auto at =
        std::lower_bound(rules_.begin(), rules_.end(), instance,
                         [](const scene::InstanceRule& one, uint64_t id) { return one.instance < id; });
    return at != rules_.end() && at->instance == instance ? at->rule : scene::DisplayRule();
}

void SortLayers::addPlaces(const base::FrameSnapshot* snapshot)
{
    for (uint32_t g = 0; snapshot && g < snapshot->groupCount(); ++g) {
        const scene::DisplayRule rule = ruleOf(snapshot->name(g).instance);
        places_.push_back({rule.layer, rule.sortKey, g});
    }
}

/// Whether all groups are in one layer, in the order that they have already.
bool SortLayers::isPlain() const
{
    return std::all_of(places_.begin(), places_.end(), [&](const Place& place) {
        return place.layer == places_.front().layer && place.sortKey == places_.front().sortKey;
    });
}

SortLayers::KeptLayer& SortLayers::keptLayer(int32_t number)
{
    for (KeptLayer& layer : kept_)
        if (layer.number == number)
            return layer;
    kept_.push_back({number, {}});
    return kept_.back();
}

/// @param otherSerial of the snapshot whose copy has to stay
const base::FrameSnapshot* SortLayers::copyOf(const base::FrameSnapshot* all, uint64_t otherSerial,
                                              KeptLayer& layer)
{
    if (!all)
        return nullptr;
    for (const Copy& copy : layer.copies)
        if (copy.serial == all->serial())
            return copy.snapshot.get();
    places_.clear();
    addPlaces(all);
    std::erase_if(places_, [&](const Place& place) { return place.layer != layer.number; });
    std::stable_sort(places_.begin(), places_.end(),
                     [](const Place& a, const Place& b) { return a.sortKey < b.sortKey; });
    groups_.clear();
    for (const Place& place : places_)
        groups_.push_back(place.group);
    Copy& copy =
        layer.copies[0].serial == otherSerial && otherSerial != 0 ? layer.copies[1] : layer.copies[0];
    copy.serial = 0; // the memory may run out on the way
    if (!copy.snapshot || &copy.snapshot->schema() != &all->schema())
        copy.snapshot = std::make_unique<base::FrameSnapshot>(&all->schema(), memory_);
    base::copyGroups(*all, groups_, *copy.snapshot);
    copy.serial = all->serial();
    return copy.snapshot.get();
}

void SortLayers::divide(const base::SnapshotPair& shown, const scene::DisplayRules& rules)
{
    layers_.clear();
    const uint64_t before = revision_;
    rules.copy(rules_, revision_);
    if (before != revision_) {
        hasOrder_ = std::any_of(rules_.begin(), rules_.end(), [](const scene::InstanceRule& one) {
            return one.rule.layer != 0 || one.rule.sortKey != 0;
        });
        for (KeptLayer& layer : kept_)
            layer.copies[0].serial = layer.copies[1].serial = 0;
    }
    if (!hasOrder_) {
        kept_.clear();
        return;
    }
    places_.clear();
    addPlaces(shown.older);
    addPlaces(shown.newer);
    if (places_.empty() || isPlain())
        return;
    std::array<bool, scene::kHighestLayer - scene::kLowestLayer + 1> isUsed{};
    for (const Place& place : places_)
        isUsed[size_t(place.layer - scene::kLowestLayer)] = true;
    std::erase_if(
        kept_, [&](const KeptLayer& layer) { return !isUsed[size_t(layer.number - scene::kLowestLayer)]; });
    const uint64_t newer = shown.newer ? shown.newer->serial() : 0;
    const uint64_t older = shown.older ? shown.older->serial() : 0;
    for (int32_t number = scene::kLowestLayer; number <= scene::kHighestLayer; ++number) {
        if (!isUsed[size_t(number - scene::kLowestLayer)])
            continue;
        KeptLayer& layer = keptLayer(number);
        base::SnapshotPair pair;
        pair.shown = shown.shown;
        pair.older = copyOf(shown.older, newer, layer);
        pair.newer = copyOf(shown.newer, older, layer);
        layers_.push_back({number, pair});
    }
}

} // namespace fx::api
