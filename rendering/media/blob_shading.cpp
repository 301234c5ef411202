#include "rendering/media/blob_shading.h"

#include "rendering/optics/black_body.h"
#include "rendering/optics/phase.h"
#include "shaders/formulas/formula.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace fx::render {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kIsotropic = 1.0f / (4.0f * kPi); ///< [1/sr]
constexpr float kTurnedShare =
    0.4f; ///< of the sun's light in a cloud, that has lost its direction by scattering
/// Share of scattered light that is scattered again. With it a thick cloud of albedo 1 is as bright as white
/// plaster: 1 / (1 - 0.75) times the isotropic 1 / (4 pi) is the 1 / pi of a white surface.
constexpr float kAgain = 0.75f;

/// Radiance scattered out of the sun's beam per albedo: once along the phase function, and again in all
/// directions, which shadows dim less because that light comes around them.
glm::vec3 sunRadiance(const GatheredBlob& blob, const ShadingContext& context)
{
    const Lighting& light = *context.lighting;
    if (light.sunIlluminance == glm::vec3(0.0f))
        return glm::vec3(0.0f);
    const glm::vec3 look = context.orthographic ? context.forward : glm::normalize(blob.center + 1e-20f);
    const float cosine =
        glm::dot(look, light.sunDirection); // 1: looking into the sun, light goes straight on
    const float phase =
        (1.0f - kTurnedShare) * henyeyGreenstein(cosine, blob.anisotropy) + kTurnedShare * kIsotropic;
    const float visible = context.shadow->transmittance(blob.center, light.sunDirection,
                                                        std::numeric_limits<float>::infinity());
    const glm::vec3 illuminance = context.sun->at(blob.center).illuminance;
    const glm::vec3 again = kAgain * blob.albedo / (1.0f - kAgain * blob.albedo);
    return illuminance * (phase * visible + again * (kIsotropic * std::sqrt(visible)));
}

/// Radiance scattered from the sky above, the ground below and the fires around, per albedo.
glm::vec3 ambientRadiance(const GatheredBlob& blob, const ShadingContext& context)
{
    const Lighting& light = *context.lighting;
    const glm::vec3 up(0.0f, 1.0f, 0.0f);
    const float above =
        context.shadow->transmittance(blob.center, up, std::numeric_limits<float>::infinity());
    const glm::vec3 ground =
        light.groundAlbedo *
        (light.sunIlluminance * (std::max(light.sunDirection.y, 0.0f) / kPi) + light.skyLuminance);
    glm::vec3 radiance =
        0.5f * light.skyLuminance * (0.25f + 0.75f * above) + 0.5f * ground * (0.5f + 0.5f * above);
    for (const BallLight& fire : context.fires)
        radiance += fire.at(blob.center).illuminance * kIsotropic;
    return radiance;
}

} // namespace

BlobInstance shadeBlob(const GatheredBlob& blob, const ShadingContext& context)
{
    const glm::vec3 thermal = blackBodyLuminance(blob.temperature);
    const glm::vec3 emitted = ((1.0f - blob.albedo) * thermal + blob.emission) * context.exposure;
    const glm::vec3 sun = blob.albedo * sunRadiance(blob, context) * context.exposure;
    const glm::vec3 sky = blob.albedo * ambientRadiance(blob, context) * context.exposure;

    BlobInstance instance;
    instance.centerRadius = {blob.center, blob.radius};
    instance.medium = {blob.crossSection, blob.heat, blob.detailAmount, blob.seed};
    instance.sun = {sun, blob.detailScale};
    instance.sky = {sky, float(blob.layer) * 2.0f + blob.fireShare};
    const glm::vec3 share = (1.0f - blob.albedo) * thermal * context.exposure;
    const float total = emitted.x + emitted.y + emitted.z;
    const float thermalShare = total > 0.0f ? (share.x + share.y + share.z) / total : 0.0f;
    instance.emission = {emitted, thermalShare * formula::fxBlackBodyContrast(blob.temperature)};
    return instance;
}

} // namespace fx::render
