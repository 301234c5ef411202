#include "rendering/reference/render/reference_scene.h"

#include "foundation/math/bits.h"
#include "rendering/reference/integral/ray_packet.h"

#include <algorithm>

namespace fx::render {

namespace {

constexpr int kMaxSize = 16384; ///< [pixel]

bool isUsable(const MediumBlob& blob)
{
    const double sum = blob.center.x + blob.center.y + blob.center.z + blob.radius + blob.crossSection +
                       blob.source.x + blob.source.y + blob.source.z;
    return base::isFinite(sum) && blob.radius > 0.0 && blob.crossSection >= 0.0 && blob.source.x >= 0.0 &&
           blob.source.y >= 0.0 && blob.source.z >= 0.0;
}

bool isUsable(const MediumDetails& details, size_t blobs)
{
    const int32_t groups = int32_t(details.groups.size());
    return details.balls.size() == blobs && details.octaves >= 1 && details.octaves <= kMaxDetailOctaves &&
           std::all_of(details.balls.begin(), details.balls.end(), [&](const MediumDetails::Ball& ball) {
               return ball.group >= -1 && ball.group < groups;
           });
}

bool isUsable(const SceneLight& lamp)
{
    const glm::dvec3 direction(lamp.direction);
    const double sum = lamp.position.x + lamp.position.y + lamp.position.z + double(lamp.intensity.x) +
                       double(lamp.intensity.y) + double(lamp.intensity.z) + double(lamp.radius);
    return base::isFinite(sum) && lamp.intensity.x >= 0.0f && lamp.intensity.y >= 0.0f &&
           lamp.intensity.z >= 0.0f && lamp.radius >= 0.0f && lamp.innerAngle >= 0.0f &&
           lamp.outerAngle >= lamp.innerAngle && !(lamp.isBall() && lamp.isSpot()) &&
           unitDirection({direction.x, direction.y, direction.z}).ok();
}

uint64_t digestOf(std::span<const MediumBlob> blobs)
{
    KeyHash hash;
    for (const MediumBlob& blob : blobs) {
        hash.add(blob.center);
        hash.add(blob.radius);
        hash.add(blob.crossSection);
        hash.add(blob.source);
        hash.add(blob.albedo);
        hash.add(blob.anisotropy);
        hash.add(blob.fireShare);
        hash.add(double(blob.layer));
    }
    return hash.value();
}

/// Of all blobs, part by part on all threads.
std::vector<uint64_t> digestsOf(std::span<const MediumBlob> blobs, base::TaskRunner& tasks)
{
    constexpr size_t kPart = 4096;
    std::vector<uint64_t> digests((blobs.size() + kPart - 1) / kPart);
    tasks.parallelFor(uint32_t(digests.size()), 1, [&](uint32_t first, uint32_t last) {
        for (size_t part = first; part < last; ++part)
            digests[part] =
                digestOf(blobs.subspan(part * kPart, std::min(kPart, blobs.size() - part * kPart)));
    });
    return digests;
}

void add(KeyHash& hash, const glm::vec3& v)
{
    hash.add(glm::dvec3(v));
}

void addDetails(KeyHash& hash, const MediumDetails& details)
{
    hash.add(double(details.octaves));
    for (const MediumDetails::Group& group : details.groups) {
        const FieldDetailNumbers& n = group.detail.numbers;
        hash.add(group.origin);
        add(hash, group.place.tint);
        if (group.volume) {
            hash.addWord(group.volume->hash());
            for (int column = 0; column < 3; ++column)
                hash.add(group.place.toVoxels[column]);
            hash.add(group.place.first);
            hash.add(group.place.density);
        }
        for (size_t g = 0; g < 2; ++g) {
            for (int column = 0; column < 3; ++column)
                add(hash, group.detail.toCells[g][column]);
            add(hash, group.detail.first[g]);
            add(hash, n.generations[g].offset);
            hash.add(double(n.generations[g].length));
            hash.add(double(n.generations[g].growth));
        }
        for (const float number : {n.fade, n.thinnest, n.densest, n.ramp, n.gain, n.cooling, n.glow,
                                   n.softening, group.detail.scale, group.detail.factor})
            hash.add(double(number));
    }
    for (const MediumDetails::Ball& ball : details.balls) {
        hash.add(double(ball.group));
        add(hash, ball.carried[0]);
        add(hash, ball.carried[1]);
        hash.add(double(ball.temperature));
        hash.add(double(ball.thinning));
    }
}

void addOpaque(KeyHash& hash, const OpaqueScene& scene)
{
    hash.add(scene.mesh.origin);
    for (const auto& column :
         {scene.mesh.positions, scene.mesh.normals, scene.mesh.colors, scene.background.image})
        hash.addBytes(column);
    const OpaqueBackground& b = scene.background;
    for (const glm::vec3& v : {b.luminance, b.horizon, scene.lighting.sunDirection,
                               scene.lighting.sunIlluminance, scene.lighting.skyLuminance})
        hash.add(glm::dvec3(v));
    for (const double number :
         {double(b.width), double(b.height), double(b.panorama), double(scene.lighting.groundAlbedo),
          double(scene.isEmpty), double(b.hasHills), double(scene.mesh.isSoil)})
        hash.add(number);
    for (const auto& lights : {std::span(scene.lights), std::span(scene.particleLights)}) {
        hash.add(double(lights.size()));
        for (const EffectLight& light : lights) {
            hash.add(light.position);
            hash.add(glm::dvec3(light.intensity));
            hash.add(double(light.radius));
        }
    }
    for (const SceneLight& lamp : scene.lamps) {
        hash.add(lamp.position);
        hash.add(glm::dvec3(lamp.intensity));
        hash.add(glm::dvec3(lamp.direction));
        for (const double number : {double(lamp.radius), double(lamp.innerAngle), double(lamp.outerAngle)})
            hash.add(number);
    }
}

base::Status refused(const char* what)
{
    return {base::Code::InvalidArgument, what};
}

} // namespace

void addScene(KeyHash& io, const ReferenceScene& scene, base::TaskRunner& tasks)
{
    for (const uint64_t part : digestsOf(scene.blobs, tasks))
        io.addWord(part);
    if (scene.details.isGiven())
        addDetails(io, scene.details);
    addOpaque(io, scene.opaque);
    const ReferenceCamera& c = scene.camera;
    for (const glm::dvec3& v : {c.eye, c.right, c.up, c.forward})
        io.add(v);
    for (const double number : {double(c.orthographic), c.halfHeight, c.nearDistance})
        io.add(number);
}

base::Status checkScene(const ReferenceScene& scene, int width, int height)
{
    if (width < 1 || height < 1 || width > kMaxSize || height > kMaxSize)
        return refused("width and height must be 1..16384");
    if (!std::all_of(scene.blobs.begin(), scene.blobs.end(),
                     [](const MediumBlob& blob) { return isUsable(blob); }))
        return refused("a blob's numbers must be finite, its radius positive, the others not negative");
    if (scene.details.isGiven() && !isUsable(scene.details, scene.blobs.size()))
        return refused("detail needs one entry for each blob, with the number of one of its groups or -1");
    const auto& lamps = scene.opaque.lamps;
    if (!std::all_of(lamps.begin(), lamps.end(), [](const SceneLight& lamp) { return isUsable(lamp); }))
        return refused(
            "a light's numbers must be finite and not negative, its direction not 0, its outer angle "
            "at least the inner, and a ball is no spot");
    const ReferenceCamera& c = scene.camera;
    for (const glm::dvec3& axis : {c.right, c.up, c.forward})
        if (!unitDirection({axis.x, axis.y, axis.z}).ok())
            return refused("the camera's axes must be finite and not 0");
    if (!base::isFinite(c.eye.x + c.eye.y + c.eye.z) || !base::isFinite(c.halfHeight) ||
        !(c.halfHeight > 0.0) || !base::isFinite(c.nearDistance) || !(c.nearDistance >= 0.0))
        return refused(
            "the camera's eye must be finite, its height above 0 and its near distance at least 0");
    return {};
}

ReferenceCamera withUnitAxes(const ReferenceCamera& camera)
{
    ReferenceCamera result = camera;
    for (glm::dvec3* axis : {&result.right, &result.up, &result.forward}) {
        const auto unit = *unitDirection({axis->x, axis->y, axis->z});
        *axis = {unit[0], unit[1], unit[2]};
    }
    return result;
}

} // namespace fx::render
