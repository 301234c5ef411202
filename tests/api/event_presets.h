/// @file event_presets.h
/// Presets whose particles have events for the host, for tests of these events.
#pragma once

#include "tests/api/api_fixture.h"

#include <cstring>
#include <string>
#include <vector>

namespace fx::test {

constexpr uint32_t kAllEvents = FX_EVENTS_FINISHED | FX_EVENTS_CUES | FX_EVENTS_UNNAMED;

/// One particle falls 1 m to the ground, bounces, and dies after 1.5 s.
inline const std::string kDrop = R"({"version":1,"name":"drop","emitters":[{"name":"drop","position":[0,1,0],
    "emission":{"bursts":[{"time":0,"count":1}]},"lifetime":1.5,"speed":0,"radius":0.01,
    "forces":{"gravity":1,"bounce":0.5},
    "events":[{"on":"birth","cue":"born"},{"on":"collision","cue":"impact"},{"on":"age","age":1,"cue":"old"},
              {"on":"death","cue":"gone"},{"on":"host","name":"knock","cue":"knocked"}]}]})";

/// Many sparks that bounce and leave smoke, a part of which has no cue.
inline const std::string kSparks =
    R"({"version":1,"name":"sparks","emitters":[{"name":"sparks","position":[0,0.5,0],
    "maxParticles":600,"emission":{"rate":400},"lifetime":{"min":0.4,"max":0.8},"speed":3,"shape":"cone",
    "angleDegrees":60,"radius":0.01,"forces":{"gravity":1,"bounce":0.6,"curlStrength":2},
    "events":[{"on":"collision","cue":"tick","probability":0.7},
              {"on":"collision","emit":"smoke","count":{"min":0,"max":3}},
              {"on":"death","emit":"smoke","cue":"fade"}]},
    {"name":"smoke","maxParticles":2000,"lifetime":0.3,"radius":0.05,
     "events":[{"on":"death","cue":"puff"}]}]})";

/// Three hundred particles, all of which die within one step, in another order than that of their birth.
inline const std::string kFlash =
    R"({"version":1,"name":"flash","emitters":[{"name":"flash","maxParticles":300,
    "emission":{"bursts":[{"time":0,"count":300}]},"lifetime":{"min":0.101,"max":0.115},"radius":0.01,
    "events":[{"on":"death","cue":"first"},{"on":"death","cue":"second"}]}]})";

/// True if all bits are equal.
inline bool areEqual(const std::vector<FxEvent>& a, const std::vector<FxEvent>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(FxEvent)) == 0;
}

} // namespace fx::test
