#include "fxsdk/scene/display_rules.h"

#include <algorithm>

namespace fx::scene {

std::pmr::vector<InstanceRule>::const_iterator DisplayRules::find(LocalId instance) const
{
    return std::lower_bound(rules_.begin(), rules_.end(), instance,
                            [](const InstanceRule& one, LocalId id) { return one.instance < id; });
}

/// The caller holds the lock.
DisplayRule DisplayRules::held(LocalId instance) const
{
    const auto at = find(instance);
    return at != rules_.end() && at->instance == instance ? at->rule : DisplayRule();
}

/// The caller holds the lock.
void DisplayRules::put(LocalId instance, const DisplayRule& rule)
{
    const auto at = find(instance);
    const bool isKnown = at != rules_.end() && at->instance == instance;
    if (!isKnown && rule.isDefault())
        return;
    if (!isKnown)
        rules_.insert(at, {instance, rule});
    else if (rule.isDefault())
        rules_.erase(at);
    else
        rules_[size_t(at - rules_.begin())].rule = rule;
    ++revision_;
}

DisplayRule DisplayRules::of(LocalId instance) const
{
    const std::lock_guard lock(mutex_);
    return held(instance);
}

void DisplayRules::set(LocalId instance, const DisplayRule& rule)
{
    const std::lock_guard lock(mutex_);
    put(instance, rule);
}

void DisplayRules::setMask(LocalId instance, uint32_t mask)
{
    const std::lock_guard lock(mutex_);
    DisplayRule rule = held(instance);
    rule.mask = mask;
    put(instance, rule);
}

void DisplayRules::setOrder(LocalId instance, int32_t layer, int32_t sortKey)
{
    const std::lock_guard lock(mutex_);
    DisplayRule rule = held(instance);
    rule.layer = layer;
    rule.sortKey = sortKey;
    put(instance, rule);
}

void DisplayRules::reserveOne()
{
    const std::lock_guard lock(mutex_);
    if (rules_.size() == rules_.capacity())
        rules_.reserve(2 * rules_.size() + 1);
}

void DisplayRules::retire(LocalId instance, uint32_t most)
{
    const std::lock_guard lock(mutex_);
    const auto at = find(instance);
    if (at == rules_.end() || at->instance != instance)
        return;
    if (retired_ < most) {
        rules_[size_t(at - rules_.begin())].publicationsLeft = kKeptPublications;
        ++retired_;
        return;
    }
    rules_.erase(at);
    ++revision_;
}

void DisplayRules::countPublication()
{
    if (retired_ == 0)
        return;
    const std::lock_guard lock(mutex_);
    const size_t ended = std::erase_if(
        rules_, [](InstanceRule& one) { return one.publicationsLeft > 0 && --one.publicationsLeft == 0; });
    retired_ -= uint32_t(ended);
    revision_ += ended > 0 ? 1 : 0;
}

void DisplayRules::replace(std::pmr::vector<InstanceRule>& rules)
{
    retired_ = 0;
    const std::lock_guard lock(mutex_);
    rules_.swap(rules);
    ++revision_;
}

void DisplayRules::copy(std::pmr::vector<InstanceRule>& out, uint64_t& ioRevision) const
{
    const std::lock_guard lock(mutex_);
    if (ioRevision == revision_)
        return;
    out.assign(rules_.begin(), rules_.end());
    ioRevision = revision_;
}

} // namespace fx::scene
