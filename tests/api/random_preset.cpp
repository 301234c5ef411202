#include "tests/api/random_preset.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace fx::test {

namespace {

using Json = nlohmann::json;

Json vector(Dice& dice, double most)
{
    return {dice.between(-most, most), dice.between(-most, most), dice.between(-most, most)};
}

Json range(double low, double high)
{
    return {{"min", low}, {"max", high}};
}

/// A curve that runs straight from one value to another.
Json line(double first, double last)
{
    return {{"keys", {{0, first}, {1, last}}}};
}

Json axis(Dice& dice)
{
    Json value = vector(dice, 1.0);
    value[1] = dice.between(0.1, 1.0);
    return value;
}

void addShape(Dice& dice, Json& emitter)
{
    constexpr const char* kShapes[] = {"point", "sphere", "box",  "cone",  "line",
                                       "disc",  "torus",  "mesh", "spline"};
    const std::string shape = kShapes[dice.below(std::size(kShapes))];
    emitter["shape"] = shape;
    emitter["position"] = vector(dice, 0.7);
    emitter["axis"] = axis(dice);
    const double size = dice.between(0.0, 1.2);
    emitter["size"] = shape == "box" ? Json{size, dice.between(0, 1), dice.between(0, 1)} : Json{size, 0, 0};
    if (shape == "cone")
        emitter["angleDegrees"] = dice.between(0, 170);
    if (shape == "cone" && dice.one(2)) {
        emitter["height"] = dice.between(0.1, 1);
        emitter["angleDegrees"] = dice.between(1, 80);
    }
    if (shape == "torus")
        emitter["tube"] = size * dice.between(0, 1);
    if (shape == "sphere" || shape == "disc")
        emitter["inner"] = dice.between(0, 1);
    if ((shape == "sphere" || shape == "box" || shape == "torus") && dice.one(3))
        emitter["surface"] = true;
    if (shape == "spline") {
        emitter["points"] = {vector(dice, 1), vector(dice, 1), vector(dice, 1)};
        emitter["closed"] = dice.one(2);
    }
    if (shape == "mesh")
        emitter["file"] = "lump.obj";
}

void addEmission(Dice& dice, Json& emitter)
{
    Json emission = Json::object();
    if (!dice.one(4))
        emission["rate"] = dice.magnitude(2, 60);
    if (emission.empty() || dice.one(4))
        emission["bursts"] = {{{"time", dice.between(0, 0.4)},
                               {"count", 1 + dice.below(30)},
                               {"cycles", 1 + dice.below(4)},
                               {"interval", dice.between(0.05, 0.5)}}};
    if (dice.one(4))
        emission["duration"] = dice.between(0.3, 1.5);
    emitter["emission"] = emission;
    const double life = dice.magnitude(0.05, 3);
    emitter["lifetime"] = range(life * dice.between(0.2, 1), life);
}

void addAir(Dice& dice, Json& forces)
{
    forces["wind"] = vector(dice, dice.one(3) ? 3 : 0);
    if (dice.one(3))
        forces["curlStrength"] = dice.magnitude(0.1, 4);
    if (dice.one(6))
        forces["quadraticDrag"] = dice.magnitude(0.1, 10);
    if (dice.one(6)) {
        forces["gust"] = {dice.between(0, 3), dice.between(0, 3), dice.between(0, 3)};
        forces["gustPeriod"] = dice.magnitude(0.05, 3);
    }
    if (dice.one(6))
        forces["vortices"] = {{{"position", vector(dice, 1)},
                               {"axis", axis(dice)},
                               {"radius", dice.between(0.1, 2)},
                               {"speed", dice.between(-5, 5)},
                               {"hold", dice.between(0, 1)}}};
    if (dice.one(6))
        forces["attractors"] = {
            {{"position", vector(dice, 2)}, {"strength", dice.between(-20, 20)}, {"softening", 0.3}}};
}

void addForces(Dice& dice, Json& emitter)
{
    Json forces = {{"gravity", dice.between(-0.3, 1)}};
    if (dice.one(2))
        forces["drag"] = dice.magnitude(0.05, 20);
    if (dice.one(4))
        forces["buoyancy"] = dice.between(0, 1);
    if (dice.one(2))
        addAir(dice, forces);
    if (dice.one(4))
        forces["bounce"] = dice.between(0, 1);
    emitter["forces"] = forces;
    const double fastest = dice.magnitude(0.05, 12);
    emitter["speed"] = range(fastest * dice.between(-0.2, 1), fastest);
    if (dice.one(5))
        emitter["collisions"] = {{{"shape", dice.one(2) ? "sphere" : "box"},
                                  {"position", vector(dice, 1)},
                                  {"size", dice.between(0.2, 1)},
                                  {"response", dice.one(2) ? "bounce" : "stick"}}};
}

void addSprite(Dice& dice, Json& look)
{
    constexpr const char* kAlignments[] = {"camera", "velocity", "axis", "plane"};
    look["alignment"] = kAlignments[dice.below(4)];
    look["axis"] = axis(dice);
    look["aspect"] = dice.magnitude(0.1, 10);
    if (look["alignment"] == "velocity")
        look["stretch"] = dice.one(3) ? 0.0 : dice.magnitude(0.005, 0.3);
    if (dice.one(2))
        look["texture"] = "spot.png";
    if (look.contains("texture") && dice.one(2)) {
        look["tileColumns"] = 2;
        look["frames"] = dice.one(2) ? "over-life" : "per-second";
        look["framesPerSecond"] = dice.between(0, 30);
        look["frameBlend"] = dice.one(2);
    }
    if (dice.one(2))
        look["softness"] = dice.between(0, 0.5);
}

void addLook(Dice& dice, Json& emitter)
{
    emitter["radius"] = range(dice.magnitude(0.01, 0.1), dice.magnitude(0.1, 0.6));
    emitter["sizeOverLife"] = line(dice.between(0, 2), dice.between(0, 2));
    constexpr const char* kKinds[] = {"medium", "sprite", "sprite", "mesh"};
    const std::string kind = kKinds[dice.below(4)];
    Json look = {{"kind", kind}};
    if (kind == "medium") {
        emitter["opticalDepth"] = dice.magnitude(0.3, 20);
        emitter["detailAmount"] = dice.one(2) ? dice.between(0, 1) : 0.0;
        if (dice.one(3))
            emitter["temperature"] = dice.between(300, 2500);
    } else {
        constexpr const char* kBlends[] = {"alpha", "additive", "opaque"};
        look["blend"] = kBlends[dice.below(3)];
        look["luminance"] = dice.magnitude(1e4, 1e6);
        look["angleDegrees"] = range(-180, 180);
        look["spinDegrees"] = dice.between(-720, 720);
        if (dice.one(4)) {
            look["fastest"] = dice.between(1, 10);
            look["sizeOverSpeed"] = line(0.5, dice.between(0.5, 3));
        }
        if (kind == "mesh")
            look["mesh"] = "library:debris-chunk.obj";
        else
            addSprite(dice, look);
    }
    emitter["appearance"] = look;
    if (kind == "medium" && dice.one(3))
        emitter["shutter"] = dice.magnitude(0.005, 0.3);
}

Json makeEmitter(Dice& dice)
{
    Json emitter = {{"maxParticles", 128}};
    addShape(dice, emitter);
    addEmission(dice, emitter);
    addForces(dice, emitter);
    addLook(dice, emitter);
    if (dice.one(4)) {
        emitter["trail"] = {{"lifetime", dice.magnitude(0.05, 1)},
                            {"width", dice.magnitude(0.02, 0.3)},
                            {"maxPoints", 3 + dice.below(20)},
                            {"luminance", 1e5},
                            {"widthAlong", line(1, dice.between(0, 3))}};
        if (dice.one(3))
            emitter["appearance"] = {{"kind", "none"}};
    }
    if (dice.one(5)) {
        emitter["space"] = "world";
        emitter["inheritVelocity"] = dice.between(0, 1);
    }
    return emitter;
}

Json makeFragments(Dice& dice)
{
    const double fastest = dice.magnitude(1, 20);
    return {{"count", 1 + dice.below(60)},
            {"position", vector(dice, 0.5)},
            {"speed", range(0.3 * fastest, fastest)},
            {"size", range(0.01, dice.magnitude(0.02, 0.3))},
            {"lifetime", range(0.5, 2)},
            {"trail", {{"spacing", dice.one(2) ? 0.0 : 0.3}, {"maxBlobs", 400}}}};
}

} // namespace

Dice::Dice(uint64_t seed) : state_(seed)
{
    state_ = next() ^ seed * 0xd6e8feb86659fd93u; // neighbors have nothing in common
}

uint64_t Dice::next() // splitmix64
{
    uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

double Dice::magnitude(double low, double high)
{
    return low * std::pow(high / low, unit());
}

std::string randomPreset(uint64_t seed, bool gpu)
{
    Dice dice(seed);
    Json preset = {{"version", 1}, {"ground", dice.one(4)}};
    if (dice.one(12)) {
        preset["fragments"] = {makeFragments(dice)};
        return preset.dump();
    }
    Json first = makeEmitter(dice);
    if (gpu && dice.one(4))
        first["compute"] = "gpu";
    if (!dice.one(5)) {
        preset["emitters"] = {first};
        return preset.dump();
    }
    Json second = makeEmitter(dice);
    second["name"] = "second";
    second.erase("emission");
    constexpr const char* kCauses[] = {"birth", "age", "collision", "death"};
    Json event = {{"on", kCauses[dice.below(4)]},
                  {"emit", "second"},
                  {"count", 1 + dice.below(3)},
                  {"inheritVelocity", dice.between(0, 1)}};
    if (event["on"] == "age")
        event["age"] = dice.between(0.05, 0.4);
    second["space"] = first.value("space", "local");
    if (second["space"] == "local")
        second.erase("inheritVelocity");
    first["events"] = {event};
    preset["emitters"] = {first, second};
    return preset.dump();
}

std::string lumpObj()
{
    return "v 0 0 0\nv 1 0 0.2\nv 0.1 1 0\nv 0 0.3 1.1\nf 1 2 3\nf 1 3 4\nf 2 3 4\n";
}

} // namespace fx::test
