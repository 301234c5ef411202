#include "tests/api/random_preset.h"

#include <nlohmann/json.hpp>

#include <bit>
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
    constexpr const char* kShapes[] = {"point", "sphere", "box",  "cone",   "line",
                                       "disc",  "torus",  "mesh", "spline", "volume"};
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
    if (shape == "volume")
        emitter["file"] = "cloud.fxgrid";
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

/// Forces that are somewhere.
void addPlaces(Dice& dice, Json& forces)
{
    constexpr const char* kFalloffs[] = {"spring", "constant", "inverse", "inverse-square"};
    if (dice.one(6))
        forces["vortices"] = {{{"position", vector(dice, 1)},
                               {"axis", axis(dice)},
                               {"radius", dice.between(0.1, 2)},
                               {"speed", dice.between(-5, 5)},
                               {"lift", dice.between(-1, 1)},
                               {"pull", dice.between(-1, 1)},
                               {"hold", dice.between(0, 1)}}};
    if (dice.one(6))
        forces["attractors"] = {{{"position", vector(dice, 2)},
                                 {"strength", dice.between(-20, 20)},
                                 {"falloff", kFalloffs[dice.below(4)]},
                                 {"reach", dice.one(2) ? 0.0 : dice.between(0.5, 2)},
                                 {"softening", 0.3}}};
    if (dice.one(8))
        forces["vectorFields"] = {{{"file", "wind.fxgrid"},
                                   {"scale", dice.between(0.5, 3)},
                                   {"strength", dice.between(-2, 2)},
                                   {"acts", dice.one(2) ? "air" : "acceleration"}}};
    if (dice.one(8))
        forces["conform"] = {{{"shape", dice.one(2) ? "sphere" : "box"},
                              {"position", vector(dice, 1)},
                              {"size", dice.between(0.2, 1)},
                              {"stiffness", dice.between(0, 60)},
                              {"damping", dice.between(0, 8)},
                              {"reach", dice.one(2) ? 0.0 : dice.between(0.5, 2)}}};
}

void addAir(Dice& dice, Json& forces)
{
    forces["wind"] = vector(dice, dice.one(3) ? 3 : 0);
    if (dice.one(3)) {
        forces["curlStrength"] = dice.magnitude(0.1, 4);
        forces["curlOctaves"] = 1 + dice.below(3);
        forces["curlRate"] = dice.between(0, 2);
    }
    if (dice.one(6))
        forces["quadraticDrag"] = dice.magnitude(0.1, 10);
    if (dice.one(6)) {
        forces["gust"] = {dice.between(0, 3), dice.between(0, 3), dice.between(0, 3)};
        forces["gustPeriod"] = dice.magnitude(0.05, 3);
    }
    addPlaces(dice, forces);
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
    if (kind == "medium" && dice.one(4))
        emitter["heat"] = dice.between(0.2, 3);
}

/// Few small solid particles that are fast in one direction: of these one can see where they end.
void sharpen(Dice& dice, Json& emitter)
{
    const double fastest = dice.between(4, 14);
    emitter["shape"] = dice.one(2) ? "box" : "cone";
    emitter["angleDegrees"] = dice.between(0, 20);
    emitter["size"] = {0.02, 0, 0};
    for (const char* shape : {"axis", "height", "surface", "inner", "points", "closed", "tube", "file"})
        emitter.erase(shape);
    emitter["speed"] = range(0.9 * fastest, fastest);
    emitter["forces"] = {{"gravity", dice.between(0, 1)}, {"drag", dice.one(2) ? 0.0 : dice.between(0, 5)}};
    const double life = dice.magnitude(0.05, 1);
    emitter["lifetime"] = range(0.5 * life, life);
    const bool isDrawnOut = dice.one(2);
    emitter["radius"] = dice.between(0.02, 0.06);
    emitter["sizeOverLife"] = line(1, 1);
    emitter["emission"] = dice.one(2) ? Json{{"rate", dice.magnitude(15, isDrawnOut ? 200 : 60)}}
                                      : Json{{"bursts",
                                              {{{"time", 0},
                                                {"count", 1 + dice.below(4)},
                                                {"cycles", 0},
                                                {"interval", dice.between(0.05, 0.3)}}}}};
    Json& look = emitter["appearance"];
    if (look["kind"] == "medium") {
        emitter["opticalDepth"] = 50;
        emitter["detailAmount"] = 0;
        emitter["shutter"] = isDrawnOut ? dice.between(0.02, 0.2) : 0.0;
    } else if (look["kind"] == "sprite") {
        for (const char* soft : {"texture", "softness", "frames", "tileColumns", "frameBlend"})
            look.erase(soft);
        look["blend"] = "opaque";
        look["alignment"] = "velocity";
        look["angleDegrees"] = 0;
        look["spinDegrees"] = 0;
        look["aspect"] = 1;
        look["stretch"] = isDrawnOut ? dice.between(0.02, 0.3) : 0.0;
    }
}

Json makeEmitter(Dice& dice)
{
    Json emitter = {{"maxParticles", 128}};
    addShape(dice, emitter);
    addEmission(dice, emitter);
    addForces(dice, emitter);
    addLook(dice, emitter);
    if (dice.one(3))
        sharpen(dice, emitter);
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

Json makeGas(Dice& dice)
{
    constexpr const char* kMaterials[] = {"tnt", "petrol", "black-powder"};
    return {{"particles", 8 + dice.below(40)},
            {"material", kMaterials[dice.below(3)]},
            {"energy", dice.magnitude(1e4, 1e6)},
            {"position", {dice.between(-0.5, 0.5), dice.between(0, 1), dice.between(-0.5, 0.5)}},
            {"start", dice.one(2) ? 0.0 : dice.between(0, 0.2)},
            {"soundSpeed", dice.between(20, 60)},
            {"throwSpeed", dice.between(0, 3)},
            {"initialBias", vector(dice, dice.one(2) ? 5 : 0)},
            {"lumpiness", dice.between(0, 1)},
            {"curlStrength", dice.between(0, 5)},
            {"opacity", dice.magnitude(1, 10)},
            {"growth", dice.between(0.5, 2)},
            {"heat", dice.between(0, 2)}};
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

namespace {

/// Every emitter but the last causes births in the next.
Json makeChain(Dice& dice, Json first, size_t length)
{
    constexpr const char* kCauses[] = {"birth", "age", "collision", "death"};
    Json emitters = {first};
    for (size_t i = 1; i < length; ++i) {
        Json next = makeEmitter(dice);
        next["name"] = "emitter " + std::to_string(i);
        next.erase("emission");
        next["space"] = first.value("space", "local");
        if (next["space"] == "local")
            next.erase("inheritVelocity");
        Json event = {{"on", kCauses[dice.below(4)]},
                      {"emit", next["name"]},
                      {"count", 1 + dice.below(3)},
                      {"inheritVelocity", dice.between(0, 1)}};
        if (event["on"] == "age")
            event["age"] = dice.between(0.05, 0.4);
        emitters.back()["events"] = Json::array({event});
        emitters.push_back(next);
    }
    return emitters;
}

std::string kindOf(const Json& emitter)
{
    if (emitter.contains("compute"))
        return "gpu";
    if (emitter.value("space", "local") == "world")
        return "world";
    if (emitter.contains("trail"))
        return "trail";
    if (emitter["shape"] == "volume")
        return "volume";
    return emitter["appearance"]["kind"];
}

} // namespace

RandomPreset randomPreset(uint64_t seed, bool gpu, bool gas)
{
    Dice dice(seed);
    Json preset = {{"version", 1}, {"ground", dice.one(4)}};
    if (dice.one(6))
        preset["wind"] = vector(dice, 2);
    if (dice.one(8))
        preset["prewarm"] = dice.between(0, 0.5);
    if (dice.one(12)) {
        preset["fragments"] = Json::array({makeFragments(dice)});
        return {preset.dump(), "fragments"};
    }
    if (gas && dice.one(12)) {
        preset["gas"] = Json::array({makeGas(dice)});
        return {preset.dump(), "gas"};
    }
    Json first = makeEmitter(dice);
    if (gpu && dice.one(4)) {
        first["compute"] = "gpu";
        for (const char* forCpuOnly : {"trail", "space", "inheritVelocity"})
            first.erase(forCpuOnly);
    }
    const size_t length = dice.one(4) && !first.contains("compute") ? 2 + dice.below(2) : 1;
    preset["emitters"] = makeChain(dice, first, length);
    return {preset.dump(), length > 1 ? "chain" : kindOf(first)};
}

RandomPreset sharpPreset(uint64_t seed)
{
    Dice dice(seed);
    Json emitter = makeEmitter(dice);
    for (const char* member : {"trail", "space", "inheritVelocity", "collisions"})
        emitter.erase(member);
    if (emitter["appearance"]["kind"] != "sprite")
        emitter["appearance"] = {{"kind", dice.one(2) ? "medium" : "sprite"}, {"luminance", 1e5}};
    sharpen(dice, emitter);
    const Json preset = {{"version", 1}, {"ground", false}, {"emitters", {emitter}}};
    return {preset.dump(), emitter["appearance"]["kind"]};
}

std::string lumpObj()
{
    return "v 0 0 0\nv 1 0 0.2\nv 0.1 1 0\nv 0 0.3 1.1\nf 1 2 3\nf 1 3 4\nf 2 3 4\n";
}

namespace {

/// 4 x 3 x 5 nodes of numbers in [low, high].
std::string grid(uint32_t channels, double low, double high)
{
    constexpr int kNodes = 4 * 3 * 5;
    std::string bytes = "fxgrid 1\nnodes 4 3 5\nchannels ";
    bytes += std::to_string(channels);
    bytes += "\nlow -0.6 -0.4 -0.5\ncell 0.4 0.3 0.2\ndata\n";
    Dice dice(channels);
    for (uint32_t i = 0; i < kNodes * channels; ++i) {
        const auto word = std::bit_cast<uint32_t>(float(dice.between(low, high)));
        for (int byte = 0; byte < 4; ++byte) // little-endian
            bytes.push_back(char(word >> (8 * byte) & 0xFF));
    }
    return bytes;
}

} // namespace

std::string cloudGrid()
{
    return grid(1, 0, 1);
}

std::string windGrid()
{
    return grid(3, -2, 2);
}

} // namespace fx::test
