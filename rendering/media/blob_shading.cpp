#include "rendering/media/blob_shading.h"

#include "rendering/optics/black_body.h"
#include "shaders/formulas/formula.h"

namespace fx::render {

BlobInstance shadeBlob(const GatheredBlob& blob, float exposure)
{
    const glm::vec3 thermal = blackBodyLuminance(blob.temperature);
    const glm::vec3 emitted = ((1.0f - blob.albedo) * thermal + blob.emission) * exposure;

    BlobInstance instance;
    instance.centerRadius = {blob.center, blob.radius};
    instance.medium = {blob.crossSection, blob.heat, blob.detailAmount, blob.seed};
    instance.scatter = {blob.albedo, blob.anisotropy};
    instance.layer = {float(blob.layer) * 2.0f + blob.fireShare, 0.0f, 0.0f, 0.0f};
    const glm::vec3 share = (1.0f - blob.albedo) * thermal * exposure;
    const float total = emitted.x + emitted.y + emitted.z;
    const float thermalShare = total > 0.0f ? (share.x + share.y + share.z) / total : 0.0f;
    instance.emission = {emitted, thermalShare * formula::fxBlackBodyContrast(blob.temperature)};
    instance.lit = {blob.center, blob.detailScale};
    return instance;
}

} // namespace fx::render
