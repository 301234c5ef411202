// The functions of fx_view_lights.h.
#include "fxsdk/api/versioned_struct.h"
#include "fxsdk/api/view_object.h"
#include "fxsdk/fx_view_lights.h"
#include "shaders/shader_library.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numbers>

namespace {

using fx::api::HostWorld;
using fx::base::Status;
using fx::render::HostLight;
using fx::render::HostLights;
using fx::render::LightKind;

static_assert(int(FX_LIGHT_SUN) == int(LightKind::Sun));
static_assert(int(FX_LIGHT_HOST) == int(LightKind::Host));
static_assert(int(FX_LIGHT_EFFECT) == int(LightKind::Effect));
static_assert(int(FX_LIGHT_SKY) == int(LightKind::Sky));
static_assert(FX_MOST_LIGHTS == fx::render::kMaxHostLights);

constexpr float kPi = std::numbers::pi_v<float>;
constexpr double kFarthest = 1e9; // [m]
constexpr float kUnitTolerance = 1e-3f;

Status checkLight(const HostWorld& world, const FxLight& given)
{
    const double farthest = world.fromMeters(kFarthest);
    fx::api::Checks check;
    check.range(given.radius, 0.0f, world.fromMeters(1e4f), "lights.radius");
    check.range3(given.position, -farthest, farthest, "lights.position");
    check.range3(given.intensity, 0.0f, 1e9f, "lights.intensity");
    const float length = glm::length(glm::make_vec3(given.axis));
    check.that(std::abs(length - 1.0f) <= kUnitTolerance,
               "lights.axis is not a unit vector: divide it by its length");
    check.range(given.outerConeAngle, 0.0f, std::nextafter(kPi, 4.0f), "lights.outerConeAngle");
    check.range(given.innerConeAngle, 0.0f, std::nextafter(kPi, 4.0f), "lights.innerConeAngle");
    check.that(given.innerConeAngle <= given.outerConeAngle,
               "lights.innerConeAngle is larger than outerConeAngle: make it smaller, or as large");
    return check.status();
}

HostLight toHostLight(const HostWorld& world, const FxLight& given)
{
    HostLight light;
    light.position = world.position(given.position);
    light.intensity = glm::make_vec3(given.intensity);
    light.radius = world.toMeters(given.radius);
    light.axis = glm::normalize(world.direction(given.axis));
    if (given.outerConeAngle < kPi - 1e-3f) {
        light.cosInner = std::cos(given.innerConeAngle);
        light.cosOuter = std::cos(given.outerConeAngle);
    }
    return light;
}

/// Lights of any version of FxLight: they lie structSize apart.
Status readLights(const HostWorld& world, const FxLight* lights, uint32_t count, HostLights& out)
{
    const auto* at = reinterpret_cast<const unsigned char*>(lights);
    for (uint32_t i = 0; i < count; ++i) {
        const auto* given = reinterpret_cast<const FxLight*>(at);
        FxLight known;
        if (Status status = fx::api::readStruct(given, "lights", fxDefaultLight(), known); !status)
            return status;
        if (Status status = checkLight(world, known); !status)
            return status;
        out.lights[out.count++] = toHostLight(world, known);
        at += given->structSize;
    }
    return {};
}

Status prepareLights(FxView& view, const FxFrameDef* frame)
{
    FxFrameDef known;
    if (Status status = fx::api::readStruct(frame, "frame", fxDefaultFrameDef(), known); !status)
        return status;
    FxFrameDef withTarget = known;
    if (known.target == FX_TARGET_TEXTURE && known.colorTexture == 0)
        withTarget.target = FX_TARGET_FRAMEBUFFER; // nothing is drawn to it yet
    fx::render::FrameRequest request;
    if (Status status = fx::api::convertFrame(view.context->world, withTarget, request); !status)
        return status;
    if (view.sleeps && view.scene->scene.showsNothing()) {
        view.prepared.reset();
        return {};
    }
    const uint64_t before = view.context->memory.allocationCount();
    fx::api::ShownFrame& frameToShow = fx::api::showFrame(view, known);
    request.interpolation = frameToShow.shown().interpolation;
    request.time = frameToShow.shown().time;
    request.instances = fx::api::instanceNames(view);
    Status status = view.renderer.prepareLights(frameToShow.shown().snapshots, request);
    frameToShow.allocations = view.context->memory.allocationCount() - before;
    if (!status)
        view.prepared.reset();
    return status;
}

/// Makes a row that is multiplied by a position in meters, in the library's axes, one for a position of the
/// host.
void convertRow(const HostWorld& world, glm::vec4& io)
{
    const glm::vec3 perMeter(io);
    world.writeDirection(perMeter, glm::value_ptr(io));
    for (int i = 0; i < 3; ++i)
        io[i] = world.toMeters(io[i]); // per unit of length of the host
}

/// The shadow of a light for positions of the host. For a point light, the rows `right` lead to meters and to
/// the library's axes, in which the other members stay.
fx::render::MediaShadowBlock forHost(const HostWorld& world, fx::render::MediaShadowBlock block)
{
    for (glm::vec4& row : block.right)
        convertRow(world, row);
    if (block.place.w > 0.5f) {
        world.writeVector(glm::vec3(block.place), glm::value_ptr(block.place));
        return block;
    }
    for (glm::vec4& row : block.up)
        convertRow(world, row);
    for (glm::vec4& row : block.along)
        convertRow(world, row);
    return block;
}

FxMediaShadow toApi(const fx::render::MediaShadowBlock& block, uint32_t texture)
{
    FxMediaShadow shadow{};
    static_assert(sizeof shadow == 2 * sizeof(uint32_t) + sizeof block);
    if (block.tiles[0].w < 0.5f)
        return shadow;
    shadow.texture = texture;
    std::memcpy(reinterpret_cast<char*>(&shadow) + offsetof(FxMediaShadow, right), &block, sizeof block);
    return shadow;
}

FxLight toApi(const HostWorld& world, const fx::render::EffectLight& light)
{
    FxLight api = fxDefaultLight();
    world.writePosition(light.position, api.position);
    std::copy_n(glm::value_ptr(light.intensity), 3, api.intensity);
    api.radius = world.fromMeters(light.radius);
    world.writeDirection({0.0f, -1.0f, 0.0f}, api.axis);
    return api;
}

FxLightCost toApi(const fx::render::LightCost& cost)
{
    FxLightCost api = {};
    api.kind = uint32_t(cost.origin.kind);
    api.index = cost.origin.index;
    api.planes = cost.planes;
    api.bytes = cost.texels * fx::render::kSliceTexelBytes;
    api.rays = cost.rays;
    return api;
}

} // namespace

bool fx::api::ShownFrame::isSameAs(const FxFrameDef& frame) const
{
    const auto same = [](const auto& a, const auto& b) { return std::memcmp(&a, &b, sizeof a) == 0; };
    return same(def.origin, frame.origin) && same(def.view, frame.view) &&
           same(def.projection, frame.projection) && def.depthConvention == frame.depthConvention &&
           def.zeroToOne == frame.zeroToOne && def.upperLeftOrigin == frame.upperLeftOrigin &&
           def.width == frame.width && def.height == frame.height && def.resetHistory == frame.resetHistory &&
           def.visibilityMask == frame.visibilityMask;
}

FxResult fxView_SetLights(FxView* view, const FxLight* lights, uint32_t count)
{
    return fx::api::insideView("fxView_SetLights", view, [&]() -> Status {
        fx::api::Checks check;
        check.that(count <= FX_MOST_LIGHTS,
                   "count is above FX_MOST_LIGHTS, 8: give those that light the media most");
        if (count > 0)
            check.notNull(lights, "lights");
        if (!check.status())
            return check.status();
        HostLights known;
        if (Status status = readLights(view->context->world, lights, count, known); !status)
            return status;
        view->prepared.reset();
        view->renderer.settings().hostLights = known;
        return {};
    });
}

FxResult fxView_PrepareLights(FxView* view, const FxFrameDef* frame)
{
    return fx::api::insideView("fxView_PrepareLights", view, [&]() -> Status {
        fx::render::GlDevice& device = *view->context->device;
        const Status status = device.pollLoss();
        return status ? device.orLost(prepareLights(*view, frame)) : status;
    });
}

FxResult fxView_GetMediaShadow(FxView* view, uint32_t kind, uint32_t index, FxMediaShadow* ioShadow)
{
    return fx::api::insideView("fxView_GetMediaShadow", view, [&]() -> Status {
        fx::api::Checks check;
        check.range(kind, uint32_t(FX_LIGHT_SUN), uint32_t(FX_LIGHT_EFFECT), "kind");
        if (!check.status())
            return check.status();
        const fx::render::ViewRenderer& renderer = view->renderer;
        const auto block =
            forHost(view->context->world, renderer.mediaShadow(LightKind(kind), index, view->origin));
        return fx::api::writeStruct(toApi(block, renderer.mediaShadowTexture()), ioShadow, "ioShadow");
    });
}

const char* fxGetMediaShadowGlsl(void)
{
    return fx::shaders::text("shared/media_shadow.glsl").data(); // a literal, which ends with a zero
}

FxResult fxView_GetEffectLightCount(FxView* view, uint32_t* outCount)
{
    return fx::api::insideView("fxView_GetEffectLightCount", view, [&]() -> Status {
        if (!outCount)
            return fx::api::invalid("outCount is null");
        *outCount = uint32_t(view->renderer.effectLights().size());
        return {};
    });
}

FxResult fxView_GetLightCostCount(FxView* view, uint32_t* outCount)
{
    return fx::api::insideView("fxView_GetLightCostCount", view, [&]() -> Status {
        if (!outCount)
            return fx::api::invalid("outCount is null");
        *outCount = uint32_t(view->renderer.lights().costCount());
        return {};
    });
}

FxResult fxView_GetLightCost(FxView* view, uint32_t index, FxLightCost* ioCost)
{
    return fx::api::insideView("fxView_GetLightCost", view, [&]() -> Status {
        const fx::render::LightList& lights = view->renderer.lights();
        if (index >= lights.costCount())
            return fx::api::invalid("the last frame has fewer lights than index");
        FxLightCost cost = toApi(lights.costOf(index));
        uint64_t rays = 0;
        for (uint32_t i = 0; i < lights.costCount(); ++i)
            rays += lights.costOf(i).rays;
        if (rays > 0)
            cost.milliseconds = float(view->renderer.fillMilliseconds() * double(cost.rays) / double(rays));
        return fx::api::writeStruct(cost, ioCost, "ioCost");
    });
}

FxResult fxView_GetEffectLight(FxView* view, uint32_t index, FxLight* ioLight)
{
    return fx::api::insideView("fxView_GetEffectLight", view, [&]() -> Status {
        const auto lights = view->renderer.effectLights();
        if (index >= lights.size())
            return fx::api::invalid("the last frame has fewer effects that shine than index");
        return fx::api::writeStruct(toApi(view->context->world, lights[index]), ioLight, "ioLight");
    });
}
