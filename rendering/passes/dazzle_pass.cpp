#include "rendering/passes/dazzle_pass.h"

#include "foundation/math/bits.h"

#include <cmath>
#include <cstddef>
#include <string>

namespace fx::render {

namespace {

constexpr int kTileSide = 16; ///< [pixel], as in shaders/dazzle/dazzle_sum.comp.glsl

/// Layout of DazzleBlock in shaders/dazzle/dazzle_shared.glsl, where each member is explained.
struct DazzleBlock
{
    int imageSize[2];
    int tileGrid[2];
    uint32_t whiteQuanta;
    int32_t quantumExponent;
    float quantum;
    float white;
    float largest;
    uint32_t resetHistory;
    double keepRise;
    double keepFall;
    double capacity;
    double perCapacity;
    double unused;
    float sensorLaw[4];
};
static_assert(sizeof(DazzleBlock) == 96 && offsetof(DazzleBlock, keepRise) == 40 &&
              offsetof(DazzleBlock, sensorLaw) == 80);

constexpr size_t kTileBytes = 56;   ///< of DazzleTile
constexpr size_t kBudgetBytes = 48; ///< of three DazzleBudget

DazzleBlock makeBlock(const DazzlePass::Inputs& in)
{
    const DazzleSettings& s = in.settings;
    const DazzleScale scale = dazzleScale(s.white);
    DazzleBlock block{};
    block.imageSize[0] = in.width;
    block.imageSize[1] = in.height;
    block.tileGrid[0] = (in.width + kTileSide - 1) / kTileSide;
    block.tileGrid[1] = (in.height + kTileSide - 1) / kTileSide;
    block.whiteQuanta = scale.whiteQuanta;
    block.quantumExponent = scale.exponent;
    block.quantum = std::ldexp(1.0f, scale.exponent);
    block.white = s.white;
    block.largest = s.white * kDazzleLargest;
    block.resetHistory = in.resetHistory ? 1 : 0;
    block.keepRise = dazzleKeep(in.deltaTime, s.riseTime);
    block.keepFall = dazzleKeep(in.deltaTime, s.fallTime);
    block.capacity = double(in.width) * in.height * scale.whiteQuanta;
    block.perCapacity = 1.0 / block.capacity;
    block.sensorLaw[0] = s.a;
    block.sensorLaw[1] = s.b;
    block.sensorLaw[2] = s.c;
    return block;
}

base::Status refuse(const char* name, float value, const char* allowed)
{
    return {base::Code::InvalidArgument,
            std::string("dazzle: ") + name + " is " + std::to_string(value) + ", allowed is " + allowed};
}

void addSum(FrameGraph& graph, const DazzlePass::Inputs& in, const DazzleBlock& block, ResourceId& outTiles)
{
    graph.addPass("dazzle sum", [&](FrameGraph::Builder& builder) {
        builder.read(in.color);
        const size_t tileCount = size_t(block.tileGrid[0]) * size_t(block.tileGrid[1]);
        outTiles = builder.write(builder.create(BufferDesc{"dazzle tiles", tileCount * kTileBytes}));
        return [color = in.color, tiles = outTiles, block](Backend& backend) {
            const TextureBinding textures[] = {{0, color}};
            const BufferBinding buffers[] = {{0, tiles}};
            DispatchCall call;
            call.program = &kDazzleSumProgram;
            call.textures = textures;
            call.buffers = buffers;
            call.uniforms = asUniforms(block);
            call.groups[0] = uint32_t(block.tileGrid[0]);
            call.groups[1] = uint32_t(block.tileGrid[1]);
            backend.dispatch(call);
        };
    });
}

void addBudget(FrameGraph& graph, const DazzlePass::Inputs& in, const DazzleBlock& block, ResourceId& ioTiles,
               ResourceId& outHistory, ResourceId& outBudget)
{
    graph.addPass("dazzle budget", [&](FrameGraph::Builder& builder) {
        ioTiles = builder.write(ioTiles);
        outHistory = builder.write(in.history);
        outBudget = builder.write(builder.create(BufferDesc{"dazzle budget", kBudgetBytes}));
        return [tiles = ioTiles, history = outHistory, budget = outBudget, block](Backend& backend) {
            const BufferBinding buffers[] = {{0, tiles}, {1, history}, {2, budget}};
            DispatchCall call;
            call.program = &kDazzleBudgetProgram;
            call.buffers = buffers;
            call.uniforms = asUniforms(block);
            backend.dispatch(call);
        };
    });
}

void addDeal(FrameGraph& graph, const DazzlePass::Inputs& in, const DazzleBlock& block, ResourceId tiles,
             ResourceId budget, ResourceId& outColor)
{
    graph.addPass("dazzle deal", [&](FrameGraph::Builder& builder) {
        builder.read(in.color);
        builder.read(tiles);
        builder.read(budget);
        outColor =
            builder.write(builder.create(TextureDesc{"dazzled", in.width, in.height, Format::RGBA32F}));
        return [color = in.color, target = outColor, tiles, budget, block](Backend& backend) {
            const TextureBinding textures[] = {{0, color}};
            const ImageBinding images[] = {{0, target}};
            const BufferBinding buffers[] = {{0, tiles}, {1, budget}};
            DispatchCall call;
            call.program = &kDazzleDealProgram;
            call.textures = textures;
            call.images = images;
            call.buffers = buffers;
            call.uniforms = asUniforms(block);
            call.groups[0] = uint32_t(block.tileGrid[0]);
            call.groups[1] = uint32_t(block.tileGrid[1]);
            backend.dispatch(call);
        };
    });
}

} // namespace

DazzleScale dazzleScale(float white)
{
    int exponent = 0;
    const float mantissa = std::frexp(white, &exponent);          // in [1/2, 1)
    const int upper = mantissa == 0.5f ? exponent - 1 : exponent; // white <= 2^upper
    return {uint32_t(std::ldexp(white, 24 - upper)), upper - 24};
}

double dazzleKeep(double deltaTime, double timeConstant)
{
    if (!(timeConstant > 0.0))
        return 0.0;
    return deltaTime > 0.0 ? std::exp(-deltaTime / timeConstant) : 1.0;
}

base::Status checkSensorLaw(const DazzleSettings& settings)
{
    const DazzleSettings& s = settings;
    if (!base::isFinite(s.white) || s.white < 1e-6f || s.white > 1e9f)
        return refuse("white", s.white, "1e-6 to 1e9");
    if (!base::isFinite(s.c) || s.c < 0.0f)
        return refuse("C", s.c, "a finite number >= 0");
    if (!base::isFinite(s.riseTime) || s.riseTime < 0.0f)
        return refuse("riseTime", s.riseTime, "a finite number >= 0");
    if (!base::isFinite(s.fallTime) || s.fallTime < 0.0f)
        return refuse("fallTime", s.fallTime, "a finite number >= 0");
    if (!base::isFinite(s.b))
        return refuse("B", s.b, "a finite number");
    const double least = s.b > 0.0f ? s.b * std::exp(-2.0) : -double(s.b); // formula sensor-law (2)
    if (!base::isFinite(s.a) || s.a < least)
        return refuse(
            "A", s.a,
            "at least B exp(-2) for B > 0 and at least -B otherwise: more light must not give less glare");
    return {};
}

DazzlePass::Outputs DazzlePass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out{in.color, in.history};
    if (!in.settings.enabled || !checkSensorLaw(in.settings).ok())
        return out;

    const DazzleBlock block = makeBlock(in);
    ResourceId tiles;
    ResourceId budget;
    addSum(graph, in, block, tiles);
    addBudget(graph, in, block, tiles, out.history, budget);
    addDeal(graph, in, block, tiles, budget, out.color);
    return out;
}

} // namespace fx::render
