#include "fxsdk/scene_file/scene_members.h"

#include "foundation/result/nearest_name.h"

#include <algorithm>
#include <sstream>

namespace fx::scene_file {

namespace {

using preset::PresetValue;

std::string textOf(double number)
{
    std::ostringstream text;
    text << number;
    return text.str();
}

void checkOrder(const PresetValue& element, double time, double before)
{
    if (!(time > before))
        element.error("time", "found " + textOf(time) + ", which is not later than the time before, " +
                                  textOf(before) + "; allowed are rising times");
}

/// Every key has the member or none has: a key without it would be ambiguous.
bool allHave(const PresetValue& value, const char* member)
{
    const size_t count = value.size("keys");
    const bool expected = count > 0 && value.element("keys", 0).has(member);
    for (size_t i = 1; i < count; ++i) {
        const PresetValue key = value.element("keys", i);
        if (key.has(member) != expected)
            key.error(expected ? "" : member,
                      std::string(expected ? "found no \"" : "found \"") + member +
                          (expected ? "\", which the first key has" : "\", which the first key has not") +
                          "; allowed is to give it in every key or in none");
    }
    return expected;
}

void readKeys(const PresetValue& value, InstancePlay& play)
{
    play.moves = allHave(value, "position");
    play.turns = allHave(value, "rotationDegrees");
    if (value.size("keys") > 0 && !play.moves && !play.turns)
        value.element("keys", 0).error(
            "", "found neither position nor rotationDegrees; allowed is either or both");
    if (play.turns && value.has("quaternion"))
        value.error("quaternion", "found beside keys with rotationDegrees; allowed is one of them");
    for (size_t i = 0; i < value.size("keys"); ++i) {
        const PresetValue element = value.element("keys", i);
        InstanceKey key;
        element.read("time", key.time);
        element.read("position", key.position);
        element.read("rotationDegrees", key.rotationDegrees);
        if (i > 0)
            checkOrder(element, key.time, play.keys.back().time);
        play.keys.push_back(key);
    }
}

std::vector<TimedValue> readSteps(const PresetValue& value, const char* member)
{
    std::vector<TimedValue> steps;
    for (const auto& [time, step] : value.steps(member)) {
        if (!steps.empty() && time <= steps.back().time)
            value.error((std::string(member) + "/steps/" + std::to_string(steps.size())).c_str(),
                        "found the time " + textOf(time) + ", which is not later than the time before, " +
                            textOf(steps.back().time) + "; allowed are rising times");
        steps.push_back({time, step});
    }
    return steps;
}

/// [s] of a trigger or jump, which can come at the same time as the one before.
double readMoment(const PresetValue& element, double start, double before)
{
    double time = 0;
    element.read("time", time);
    if (time < start)
        element.error("time", "found " + textOf(time) + ", before the instance's start; allowed is " +
                                  textOf(start) + " or later");
    else if (time < before)
        element.error("time", "found " + textOf(time) + ", before the time before, " + textOf(before) +
                                  "; allowed are times that do not fall");
    return time;
}

} // namespace

InstancePlay readPlay(const PresetValue& value, double start)
{
    InstancePlay play;
    readKeys(value, play);
    play.speed = readSteps(value, "speed");
    play.emitting = readSteps(value, "emitting");
    if (valueAt(play.emitting, start, 1.0) == 0.0)
        value.error("emitting",
                    "found false when the instance starts, with which it ends at once; allowed is true "
                    "at first, or a later start");
    for (size_t i = 0; i < value.size("triggers"); ++i) {
        const PresetValue element = value.element("triggers", i);
        Trigger trigger;
        trigger.time = readMoment(element, start, i > 0 ? play.triggers.back().time : start);
        element.read("name", trigger.name);
        element.read("count", trigger.count);
        play.triggers.push_back(std::move(trigger));
    }
    for (size_t i = 0; i < value.size("seek"); ++i) {
        const PresetValue element = value.element("seek", i);
        TimeJump jump;
        jump.time = readMoment(element, start, i > 0 ? play.jumps.back().time : start);
        element.read("to", jump.to);
        play.jumps.push_back(jump);
    }
    return play;
}

void checkTriggers(const PresetValue& value, const InstancePlay& play, std::span<const std::string> known)
{
    for (size_t i = 0; i < play.triggers.size(); ++i) {
        const std::string& name = play.triggers[i].name;
        if (std::find(known.begin(), known.end(), name) != known.end())
            continue;
        std::string message = "found \"" + name + "\", which the preset does not hear";
        if (const std::string question = base::didYouMean(name, known); !question.empty())
            message += question;
        else if (known.empty())
            message += "; give one of its emitters an event with \"on\": \"host\" and this name";
        else {
            message += "; it hears:";
            for (const std::string& candidate : known)
                message += " " + candidate;
        }
        value.element("triggers", i).error("name", message);
    }
}

} // namespace fx::scene_file
