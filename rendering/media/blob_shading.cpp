#include "rendering/media/blob_shading.h"

#include "rendering/optics/black_body.h"
#include "shaders/formulas/formula.h"

#include <algorithm>
#include <numbers>

namespace fx::render {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;
/// Radiance scattered from the sky above and the ground below, per albedo.
glm::vec3 ambientRadiance(const Lighting& light)
{
    const glm::vec3 ground =
        light.groundAlbedo *
        (light.sunIlluminance * (std::max(light.sunDirection.y, 0.0f) / kPi) + light.skyLuminance);
    return 0.5f * (light.skyLuminance + ground);
}

} // namespace

BlobInstance shadeBlob(const GatheredBlob& blob, const ShadingContext& context)
{
    const glm::vec3 thermal = blackBodyLuminance(blob.temperature);
    const glm::vec3 emitted = ((1.0f - blob.albedo) * thermal + blob.emission) * context.exposure;
    const glm::vec3 sky = blob.albedo * ambientRadiance(*context.lighting) * context.exposure;

    BlobInstance instance;
    instance.centerRadius = {blob.center, blob.radius};
    instance.medium = {blob.crossSection, blob.heat, blob.detailAmount, blob.seed};
    instance.scatter = {blob.albedo, blob.anisotropy};
    instance.sky = {sky, float(blob.layer) * 2.0f + blob.fireShare};
    const glm::vec3 share = (1.0f - blob.albedo) * thermal * context.exposure;
    const float total = emitted.x + emitted.y + emitted.z;
    const float thermalShare = total > 0.0f ? (share.x + share.y + share.z) / total : 0.0f;
    instance.emission = {emitted, thermalShare * formula::fxBlackBodyContrast(blob.temperature)};
    instance.lit = {blob.center, blob.detailScale};
    return instance;
}

} // namespace fx::render
