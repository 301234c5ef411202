#include "simulation/world/cue_record.h"

#include <algorithm>

namespace fx::sim {

namespace {

bool isEarlierInSimulation(const CueEvent& a, const CueEvent& b)
{
    if (a.tick != b.tick)
        return a.tick < b.tick;
    if (happensBefore(a.event, b.event) || happensBefore(b.event, a.event))
        return happensBefore(a.event, b.event);
    return a.rule < b.rule;
}

/// Order in which events are kept. A shared simulation has the order of its first instance, so that the same
/// events are kept as without sharing.
bool isKeptBefore(const CueEvent& a, const CueEvent& b)
{
    if (a.tick != b.tick)
        return a.tick < b.tick;
    return a.order != b.order ? a.order < b.order : isEarlierInSimulation(a, b);
}

bool isListedBefore(const CueEvent& a, const CueEvent& b)
{
    return a.order != b.order ? a.order < b.order : isEarlierInSimulation(a, b);
}

} // namespace

void CueRecord::clear()
{
    kept_.clear();
    hasAny_ = false;
    asked_ = nullptr;
}

void CueRecord::select(uint32_t order, const InstanceClock& clock, uint64_t& ioAsked)
{
    order_ = order;
    clock_ = &clock;
    asked_ = &ioAsked;
}

void CueRecord::post(const ParticleEvent& event, const EventRule& rule, uint32_t number,
                     const base::Placement* home)
{
    if (!(rule.cue == kNoCue ? unnamed_ : named_))
        return;
    hasAny_ = true;
    ++*asked_;
    CueEvent cue{event,    event.position, clock_->toScene(event.tick), order_, number,
                 rule.cue, home != nullptr};
    if (home) {
        cue.position = home->position + glm::dvec3(home->rotation * (home->scale * event.position));
        cue.event.velocity = home->rotation * (home->scale * event.velocity);
        cue.event.normal = home->rotation * event.normal;
        cue.event.speed *= home->scale;
    }
    if (kept_.size() < kept_.capacity()) {
        kept_.push_back(cue);
        std::push_heap(kept_.begin(), kept_.end(), isKeptBefore);
    } else if (!kept_.empty() && isKeptBefore(cue, kept_.front())) {
        std::pop_heap(kept_.begin(), kept_.end(), isKeptBefore);
        kept_.back() = cue;
        std::push_heap(kept_.begin(), kept_.end(), isKeptBefore);
    }
}

void CueRecord::lose(uint64_t count)
{
    hasAny_ = hasAny_ || count > 0;
    *asked_ += count;
}

void CueRecord::sort()
{
    std::make_heap(kept_.begin(), kept_.end(), isListedBefore);
    std::sort_heap(kept_.begin(), kept_.end(), isListedBefore);
}

std::span<const CueEvent> CueRecord::of(uint32_t order) const
{
    const auto isBefore = [](const CueEvent& event, uint32_t wanted) { return event.order < wanted; };
    const auto begin = std::lower_bound(kept_.begin(), kept_.end(), order, isBefore);
    const auto end = std::lower_bound(begin, kept_.end(), order + 1, isBefore);
    return {kept_.data() + (begin - kept_.begin()), size_t(end - begin)};
}

} // namespace fx::sim
