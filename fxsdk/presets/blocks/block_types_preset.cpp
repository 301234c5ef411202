#include "foundation/random/philox.h"
#include "fxsdk/presets/blocks/block_parts_preset.h"
#include "fxsdk/presets/emitters/emitter_technique.h"
#include "simulation/blocks/block_builders.h"
#include "simulation/motion/blob_optics.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace fx::preset {

namespace {

constexpr std::array<std::pair<std::string_view, sim::BlockForm>, 4> kForms{{
    {"cloud", sim::BlockForm::Cloud},
    {"plume", sim::BlockForm::Plume},
    {"dustWall", sim::BlockForm::DustWall},
    {"nebula", sim::BlockForm::Nebula},
}};

constexpr std::array<std::pair<std::string_view, sim::BlockTurn>, 3> kTurns{{
    {"none", sim::BlockTurn::None},
    {"upright", sim::BlockTurn::Upright},
    {"free", sim::BlockTurn::Free},
}};

/// Index of a type; types.size() for an unknown name.
size_t typeNamed(const std::string& name, std::span<const sim::BlockType> types)
{
    const auto found = std::find_if(types.begin(), types.end(),
                                    [&](const sim::BlockType& type) { return type.name == name; });
    return size_t(found - types.begin());
}

std::string unknownType(const std::string& name)
{
    return "found no type \"" + name + "\" before; types that others consist of come first";
}

/// What a ball is made of, for the optical depth along a diameter.
void readMatter(const PresetValue& element, float opticalDepth, sim::ListedBall& io)
{
    io.crossSection = sim::crossSectionOf(opticalDepth, io.radius);
    element.read("temperature", io.temperature);
    element.read("albedo", io.albedo);
    element.read("emission", io.emission);
}

void readBalls(const PresetValue& element, sim::BallList& out)
{
    for (size_t i = 0; i < element.size("balls"); ++i) {
        const PresetValue ball = element.element("balls", i);
        sim::ListedBall& made = out.emplace_back();
        made.radius = 0.5f;
        ball.read("position", made.center);
        ball.read("radius", made.radius);
        float opticalDepth = 1.0f;
        ball.read("opticalDepth", opticalDepth);
        readMatter(ball, opticalDepth, made);
    }
}

void readFile(const PresetValue& element, sim::BallList& out)
{
    const base::Result<std::string> bytes = element.readAsset("file", sim::kMaxBallListBytes);
    if (!bytes)
        return element.error("file", bytes.status().message());
    base::Result<std::shared_ptr<const sim::BallList>> balls = sim::parseBallList(*bytes);
    if (!balls)
        return element.error("file", balls.status().message());
    out = **balls;
}

sim::BlockBuild readBuild(const PresetValue& builder)
{
    sim::BlockBuild build;
    builder.read("form", std::span<const std::pair<std::string_view, sim::BlockForm>>(kForms), build.form);
    builder.read("count", build.count);
    builder.read("seed", build.seed);
    builder.read("position", build.position);
    builder.read("size", build.size);
    base::Range radius{1.0f, 1.0f};
    builder.read("radius", radius);
    build.smallest = radius.min;
    build.largest = radius.max;
    builder.read("radiusExponent", build.radiusExponent);
    builder.read("noise", build.noise);
    builder.read("noiseLength", build.noiseLength);
    builder.read("octaves", build.octaves);
    builder.read("towers", build.towers);
    builder.read("base", build.base);
    builder.read("anvil", build.anvil);
    builder.read("lean", build.lean);
    return build;
}

std::vector<sim::BlockLump> readLumps(const PresetValue& element, const sim::BlockBuild& build)
{
    std::vector<sim::BlockLump> lumps = sim::buildLumps(build);
    if (lumps.empty())
        element.error("builder", "the form has no room for any lump; make it larger, or lower base");
    else if (lumps.size() < build.count)
        element.child("builder").warning("count", "the form has room for " + std::to_string(lumps.size()) +
                                                      " lumps only; make it larger");
    return lumps;
}

void readBuiltBalls(const PresetValue& element, sim::BallList& out)
{
    const PresetValue builder = element.child("builder");
    float opticalDepth = 1.0f;
    builder.read("opticalDepth", opticalDepth);
    for (const sim::BlockLump& lump : readLumps(element, readBuild(builder))) {
        sim::ListedBall& ball = out.emplace_back();
        ball.center = lump.position;
        ball.radius = lump.radius;
        readMatter(builder, opticalDepth, ball);
    }
}

void readLoop(const PresetValue& element, sim::BlockType& out)
{
    const std::shared_ptr<const sim::EmitterDef> emitter = readBlockEmitter(element);
    if (!emitter)
        return;
    sim::BlockLoop::Settings settings;
    element.read("period", settings.period);
    element.read("frames", settings.frames);
    element.read("seed", settings.seed);
    element.read("phases", out.phases);
    base::Result<std::shared_ptr<const sim::BlockLoop>> loop = sim::BlockLoop::record(*emitter, settings);
    if (!loop)
        return element.error("emitter", loop.status().message());
    out.loop = std::move(*loop);
}

/// Content of a type, of which there is exactly one.
void readContent(const PresetValue& element, std::span<const sim::BlockType> before, sim::BlockType& out)
{
    size_t contents = 0;
    for (const char* member : {"balls", "file", "builder", "emitter", "blocks"})
        contents += element.has(member) ? 1 : 0;
    if (contents != 1)
        return element.error("name", "found " + std::to_string(contents) +
                                         " contents of the type; it needs one of balls, file, builder, "
                                         "emitter and blocks");
    if (element.has("balls"))
        readBalls(element, out.balls);
    else if (element.has("file"))
        readFile(element, out.balls);
    else if (element.has("emitter"))
        readLoop(element, out);
    else if (element.has("blocks"))
        readBlockList(element, before, out.blocks);
    else if (element.child("builder").has("of"))
        readBuiltBlocks(element, before, out.blocks);
    else
        readBuiltBalls(element, out.balls);
}

/// @return false after an error
bool checkTotals(const PresetValue& element, const std::vector<sim::BlockType>& types)
{
    size_t balls = 0, blocks = 0;
    for (const sim::BlockType& type : types) {
        balls += type.balls.size() + (type.loop ? size_t(type.loop->rowCount()) : 0);
        blocks += type.blocks.size();
    }
    if (balls <= sim::kMaxBlockBalls && blocks <= sim::kMaxBlockPlaces)
        return true;
    element.error("types", "found " + std::to_string(balls) + " balls and " + std::to_string(blocks) +
                               " blocks in types; allowed are " + std::to_string(sim::kMaxBlockBalls) +
                               " and " + std::to_string(sim::kMaxBlockPlaces) +
                               "; use blocks of fewer types");
    return false;
}

} // namespace

void readBlockTypes(const PresetValue& element, std::vector<sim::BlockType>& out)
{
    for (size_t i = 0; i < element.size("types"); ++i) {
        const PresetValue type = element.element("types", i);
        sim::BlockType made;
        type.read("name", made.name);
        if (typeNamed(made.name, out) < out.size())
            type.error("name", "found a second type \"" + made.name + "\"; names differ");
        readContent(type, out, made);
        out.push_back(std::move(made));
        if (const base::Status status = sim::completeTypes(out); !status)
            return type.error("name", "the type " + status.message());
        if (!checkTotals(element, out))
            return;
    }
}

void readBlockList(const PresetValue& element, std::span<const sim::BlockType> types,
                   std::vector<sim::BlockPlacement>& out)
{
    for (size_t i = 0; i < element.size("blocks"); ++i) {
        const PresetValue block = element.element("blocks", i);
        std::string name;
        block.read("type", name);
        const size_t type = typeNamed(name, types);
        if (type == types.size()) {
            block.error("type", unknownType(name));
            continue;
        }
        sim::BlockPlacement placed;
        placed.type = uint32_t(type);
        block.read("position", placed.position);
        block.read("scale", placed.scale);
        block.read("density", placed.density);
        glm::vec3 axis(0.0f, 1.0f, 0.0f);
        block.read("axis", axis);
        if (!(glm::length(axis) > 0.0f)) {
            block.error("axis", "found an axis of length 0");
            continue;
        }
        float degrees = 0.0f, phase = 0.0f;
        block.read("angleDegrees", degrees);
        placed.rotation = glm::angleAxis(glm::radians(degrees), glm::normalize(axis));
        block.read("phase", phase);
        const uint32_t phases = types[type].phases;
        placed.phase = std::min(uint32_t(phase * float(phases)), phases - 1);
        out.push_back(placed);
    }
}

void readBuiltBlocks(const PresetValue& element, std::span<const sim::BlockType> types,
                     std::vector<sim::BlockPlacement>& out)
{
    const PresetValue builder = element.child("builder");
    const std::vector<uint32_t> of = readBlockNames(builder, types);
    if (of.empty())
        return;
    float density = 1.0f;
    builder.read("density", density);
    const sim::BlockTurn turn = readBlockTurn(builder);
    const sim::BlockBuild build = readBuild(builder);
    uint64_t index = 0;
    for (const sim::BlockLump& lump : readLumps(element, build)) {
        const auto u = base::randomUnit4(build.seed, 2, index, base::RandomPurpose::Attributes);
        sim::BlockPlacement placed;
        placed.type = of[std::min(size_t(u[0] * float(of.size())), of.size() - 1)];
        const sim::BlockType& type = types[placed.type];
        placed.position = lump.position;
        placed.rotation = sim::turnOf(turn, build.seed, index++);
        placed.scale = lump.radius / std::max(type.radius, 1e-6f);
        placed.density = density;
        placed.phase = std::min(uint32_t(u[1] * float(type.phases)), type.phases - 1);
        out.push_back(placed);
    }
}

std::vector<uint32_t> readBlockNames(const PresetValue& element, std::span<const sim::BlockType> types)
{
    std::vector<uint32_t> indices;
    for (size_t i = 0; i < element.size("of"); ++i) {
        std::string name;
        element.element("of", i).read("type", name);
        const size_t type = typeNamed(name, types);
        if (type == types.size())
            element.element("of", i).error("type", unknownType(name));
        else
            indices.push_back(uint32_t(type));
    }
    return indices;
}

sim::BlockTurn readBlockTurn(const PresetValue& element)
{
    sim::BlockTurn turn = sim::BlockTurn::Upright;
    element.read("turn", std::span<const std::pair<std::string_view, sim::BlockTurn>>(kTurns), turn);
    return turn;
}

std::shared_ptr<const sim::EmitterDef> readBlockEmitter(const PresetValue& element,
                                                        const sim::FieldDetail& detail)
{
    const PresetValue member = element.child("emitter");
    if (member.has("detail")) {
        member.error("detail", "the detail is that of all blocks; move it to the element of \"blocks\"");
        return nullptr;
    }
    for (const char* refused : {"events", "trail", "light"})
        if (member.has(refused)) {
            member.error(refused, "the emitter of blocks has no " + std::string(refused) + "; remove it");
            return nullptr;
        }
    sim::EffectDef effect;
    buildEmitter(member, effect);
    std::shared_ptr<const sim::SolverDef> made =
        effect.solvers.empty() ? nullptr
                               : std::shared_ptr<const sim::SolverDef>(std::move(effect.solvers[0]));
    auto emitter = std::dynamic_pointer_cast<const sim::EmitterDef>(made);
    if (!emitter)
        return nullptr;
    if (emitter->appearance.kind != sim::AppearanceKind::Medium) {
        member.error("appearance", "the emitter of blocks is a medium; remove its appearance");
        return nullptr;
    }
    if (emitter->inWorld) {
        member.error("space", "the particles of the emitter of blocks move with the instance; remove it");
        return nullptr;
    }
    if (!detail.given)
        return emitter;
    auto detailed = std::make_shared<sim::EmitterDef>(*emitter);
    detailed->detail = detail;
    return detailed;
}

} // namespace fx::preset
