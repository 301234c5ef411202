#include "fxsdk/presets/emitters/emitter_parts_preset.h"

#include "foundation/result/nearest_name.h"
#include "simulation/emitters/emitter_def.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fx::preset {

namespace {

constexpr std::array<std::pair<std::string_view, sim::EventKind>, 5> kKinds{
    {{"birth", sim::EventKind::Birth},
     {"age", sim::EventKind::Age},
     {"collision", sim::EventKind::Collision},
     {"death", sim::EventKind::Death},
     {"host", sim::EventKind::Host}}};

/// The emitters of one preset while they are joined.
class EventLinks
{
public:
    EventLinks(const PresetValue& root, sim::EffectDef& effect) : root_(root), effect_(effect)
    {
        const std::vector<const sim::EmitterDef*> emitters = sim::emittersOf(effect);
        for (size_t i = 0; i < root.size("emitters"); ++i) {
            emitters_.push_back(*emitters[i]);
            names_.push_back(emitters_.back().name);
        }
    }

    void link()
    {
        for (uint32_t i = 0; i < emitters_.size(); ++i) {
            const PresetValue element = root_.element("emitters", i);
            for (size_t k = 0; k < element.size("events"); ++k)
                readRule(element.element("events", k), i);
        }
        state_.resize(emitters_.size());
        for (uint32_t i = 0; hasRules_ && i < emitters_.size(); ++i)
            visit(i);
        for (uint32_t i = 0; !isBroken_ && i < emitters_.size(); ++i) // what a broken rule meant is unknown
            demandBirths(i);
        if (!hasRules_)
            return;
        std::reverse(effect_.order.begin(), effect_.order.end());
        for (uint32_t i = uint32_t(emitters_.size()); i < effect_.solvers.size(); ++i)
            effect_.order.push_back(i);
        for (size_t i = 0; i < emitters_.size(); ++i)
            effect_.solvers[i] = std::make_unique<const sim::EmitterDef>(std::move(emitters_[i]));
    }

private:
    enum class Visit : uint8_t
    {
        Not,
        Open, ///< what it causes is being visited
        Done
    };

    void readRule(const PresetValue& value, uint32_t emitter);
    bool findTarget(const PresetValue& value, uint32_t& out) const;
    static uint32_t placeIn(std::vector<std::string>& names, const std::string& name);
    void readBirths(const PresetValue& value, sim::EventRule& rule) const;
    bool readTarget(const PresetValue& value, uint32_t emitter, sim::EventRule& rule);
    void demandBirths(uint32_t emitter) const;
    void visit(uint32_t emitter);

    const PresetValue& root_;
    sim::EffectDef& effect_;
    std::vector<sim::EmitterDef> emitters_;
    std::vector<std::string> names_;
    std::vector<Visit> state_;
    std::vector<uint32_t> path_; ///< emitters that are open
    bool hasRules_ = false;
    bool isBroken_ = false; ///< the emitter of a rule was not found, or there is a circle
};

bool EventLinks::findTarget(const PresetValue& value, uint32_t& out) const
{
    std::string name;
    value.read("emit", name);
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) {
        const std::string question = base::didYouMean(name, names_);
        value.error("emit", "found \"" + name + "\", which is no emitter of the preset" +
                                (question.empty() ? "; needed is the name of one" : question));
        return false;
    }
    if (std::count(names_.begin(), names_.end(), name) > 1) {
        value.error("emit",
                    "found \"" + name + "\", which several emitters are named; give each its own name");
        return false;
    }
    out = uint32_t(found - names_.begin());
    return true;
}

/// Index of `name`, which is added if it is new.
uint32_t EventLinks::placeIn(std::vector<std::string>& names, const std::string& name)
{
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end())
        return uint32_t(found - names.begin());
    names.push_back(name);
    return uint32_t(names.size() - 1);
}

void EventLinks::readRule(const PresetValue& value, uint32_t emitter)
{
    sim::EventRule rule;
    value.read("on", std::span<const std::pair<std::string_view, sim::EventKind>>(kKinds), rule.on);
    double age = 0;
    value.read("age", age);
    rule.age = base::toTicks(age);
    double every = 0;
    value.read("every", every);
    rule.every = base::toTicks(every);
    if (value.has("every") && rule.on != sim::EventKind::Age)
        value.error("every", "found a repetition; only the event age has one");
    if (every > 0 && double(emitters_[emitter].lifetime.max) > every * double(sim::kMaxEventAges))
        value.error("every", "found more than " + std::to_string(sim::kMaxEventAges) +
                                 " repetitions in the longest life; a longer time between them is needed");
    if (value.has("minSpeed")) {
        value.read("minSpeed", rule.minSpeed);
        rule.minLastSpeed = rule.minSpeed;
        if (rule.on != sim::EventKind::Collision)
            value.error("minSpeed", "found a least speed; only the event collision has one");
    }
    if ((rule.on == sim::EventKind::Age) != value.has("age"))
        value.error("age", value.has("age") ? "found an age; only the event age has one"
                                            : "found no age; the event age needs one");
    if ((rule.on == sim::EventKind::Host) != value.has("name"))
        value.error("name", value.has("name") ? "found a name; only the event host has one"
                                              : "found no name; the event host needs one");
    std::string name;
    value.read("name", name);
    if (rule.on == sim::EventKind::Host)
        rule.hostEvent = placeIn(effect_.hostEvents, name);
    value.read("probability", rule.probability);
    hasRules_ = true;
    if (value.has("cue")) {
        value.read("cue", name);
        rule.cue = placeIn(effect_.cues, name);
    }
    readBirths(value, rule);
    if (value.has("emit") ? readTarget(value, emitter, rule) : value.has("cue"))
        emitters_[emitter].events.push_back(rule);
}

/// Members of births, which a rule without "emit" does not have.
void EventLinks::readBirths(const PresetValue& value, sim::EventRule& rule) const
{
    if (!value.has("emit")) {
        if (!value.has("cue"))
            value.error("", "found neither the member \"emit\" nor \"cue\"; an event needs one of them");
        for (const char* member : {"count", "inheritVelocity", "inheritColor"})
            if (value.has(member))
                value.error(member, "found a member of births in an event without \"emit\"; take it out, or "
                                    "name the emitter that gives birth");
        rule.target = sim::kNoTarget;
        return;
    }
    base::Range count{1, 1};
    value.read("count", count);
    if (count.min != std::floor(count.min) || count.max != std::floor(count.max))
        value.error("count", "found a fraction; births are counted in whole numbers");
    rule.fewest = uint32_t(std::max(count.min, 0.0f));
    rule.most = uint32_t(std::max(count.max, 0.0f));
    value.read("inheritVelocity", rule.inheritVelocity);
    value.read("inheritColor", rule.inheritColor);
}

/// @return whether the emitter of the births was found
bool EventLinks::readTarget(const PresetValue& value, uint32_t emitter, sim::EventRule& rule)
{
    if (!findTarget(value, rule.target)) {
        isBroken_ = true;
        return false;
    }
    sim::EmitterDef& target = emitters_[rule.target];
    if (target.inWorld != emitters_[emitter].inWorld)
        value.error("emit",
                    "found \"" + target.name + "\" in another space; give both emitters the same \"space\"");
    target.fed = true;
    target.tinted = target.tinted || rule.inheritColor > 0.0f;
    return true;
}

void EventLinks::demandBirths(uint32_t emitter) const
{
    const sim::EmitterDef& def = emitters_[emitter];
    if (def.emission.rate > 0 || !def.emission.bursts.empty() || def.fed)
        return;
    const bool hears = std::any_of(def.events.begin(), def.events.end(),
                                   [](const auto& rule) { return rule.on == sim::EventKind::Host; });
    const PresetValue element = root_.element("emitters", emitter);
    if (hears)
        return;
    if (element.has("emission"))
        element.error("emission", "found neither a rate above 0 nor bursts: nothing would ever be born");
    else
        element.error("", "the member \"emission\" is missing; it is needed where no events give birth");
}

/// Puts an emitter behind all that it causes; the order is turned around in the end.
void EventLinks::visit(uint32_t emitter)
{
    if (state_[emitter] == Visit::Done)
        return;
    if (state_[emitter] == Visit::Open) {
        std::string chain;
        for (auto at = std::find(path_.begin(), path_.end(), emitter); at != path_.end(); ++at)
            chain += names_[*at] + " -> ";
        isBroken_ = true;
        root_.element("emitters", emitter)
            .error("events", "found a circle of events, " + chain + names_[emitter] +
                                 ": births would never end; take one event of it out");
        return;
    }
    state_[emitter] = Visit::Open;
    path_.push_back(emitter);
    for (const sim::EventRule& rule : emitters_[emitter].events)
        if (rule.target != sim::kNoTarget)
            visit(rule.target);
    path_.pop_back();
    state_[emitter] = Visit::Done;
    effect_.order.push_back(emitter);
}

} // namespace

void linkEmitterEvents(const PresetValue& root, sim::EffectDef& effect)
{
    if (effect.solvers.size() >= root.size("emitters"))
        EventLinks(root, effect).link();
}

} // namespace fx::preset
