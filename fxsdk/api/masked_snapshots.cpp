#include "fxsdk/api/masked_snapshots.h"

#include <utility>

namespace fx::api {

void MaskedSnapshots::forget()
{
    revision_ = 0;
    for (Copy& copy : copies_)
        copy.serial = 0;
}

base::SnapshotPair MaskedSnapshots::shown(const base::SnapshotPair& all, const scene::DisplayRules& rules,
                                          uint32_t mask)
{
    const uint64_t before = revision_;
    rules.copy(rules_, revision_);
    if (before != revision_ || mask_ != mask) {
        mask_ = mask;
        for (Copy& copy : copies_)
            copy.serial = 0;
        hidden_.clear();
        for (const scene::InstanceRule& one : rules_)
            if ((one.rule.mask & mask) == 0)
                hidden_.push_back(one.instance);
    }
    if (mask == 0) // instances without an entry too
        return {};
    const uint64_t newer = all.newer ? all.newer->serial() : 0, older = all.older ? all.older->serial() : 0;
    base::SnapshotPair pair;
    pair.shown = all.shown;
    pair.older = shown(all.older, newer);
    pair.newer = shown(all.newer, older);
    return pair;
}

/// @param otherSerial of the snapshot whose copy has to stay
const base::FrameSnapshot* MaskedSnapshots::shown(const base::FrameSnapshot* all, uint64_t otherSerial)
{
    if (!all || !base::hasGroupOf(*all, hidden_))
        return all;
    for (const Copy& copy : copies_)
        if (copy.serial == all->serial())
            return copy.snapshot.get();
    Copy& copy = copies_[0].serial == otherSerial && otherSerial != 0 ? copies_[1] : copies_[0];
    copy.serial = 0; // the memory may run out on the way
    if (!copy.snapshot || &copy.snapshot->schema() != &all->schema())
        copy.snapshot = std::make_unique<base::FrameSnapshot>(&all->schema(), memory_);
    base::copyWithout(*all, hidden_, *copy.snapshot);
    copy.serial = all->serial();
    return copy.snapshot.get();
}

} // namespace fx::api
