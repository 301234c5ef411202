#include "rendering/reference/render/reference_renderer.h"

#include "foundation/math/bits.h"
#include "foundation/math/hash.h"
#include "rendering/reference/render/blob_light.h"

#include <algorithm>
#include <array>
#include <bit>

namespace fx::render {

namespace {

constexpr uint64_t kVersion =
    3; ///< of the arithmetic: another picture from the same input gets another number
constexpr int kMaxSize = 16384; ///< [pixel]
constexpr int kMaxSamples = 16;

/// Hashes what the picture depends on, number by number: structs have gaps. Four chains in turn, since a
/// processor waits for each word of one.
class KeyHash
{
public:
    void add(double x) { addWord(std::bit_cast<uint64_t>(x)); }
    void add(const glm::dvec3& v)
    {
        add(v.x);
        add(v.y);
        add(v.z);
    }
    void addWord(uint64_t word)
    {
        uint64_t& chain = chains_[next_++ % chains_.size()];
        chain = base::hashWord(chain, word);
    }
    template <class T>
    void addBytes(std::span<const T> values)
    {
        addWord(base::hashBytes(kVersion, values.data(), values.size_bytes()));
    }
    uint64_t value() const { return base::hashBytes(next_, chains_.data(), sizeof(chains_)); }

private:
    std::array<uint64_t, 4> chains_{kVersion, kVersion, kVersion, kVersion};
    size_t next_ = 0;
};

bool isUsable(const MediumBlob& blob)
{
    const double sum = blob.center.x + blob.center.y + blob.center.z + blob.radius + blob.crossSection +
                       blob.source.x + blob.source.y + blob.source.z;
    return base::isFinite(sum) && blob.radius > 0.0 && blob.crossSection >= 0.0 && blob.source.x >= 0.0 &&
           blob.source.y >= 0.0 && blob.source.z >= 0.0;
}

/// Some blobs of the list.
struct BlobDigest
{
    uint64_t hash = 0;
    bool isUsable = true;
};

BlobDigest digestOf(std::span<const MediumBlob> blobs)
{
    KeyHash hash;
    BlobDigest digest;
    for (const MediumBlob& blob : blobs) {
        hash.add(blob.center);
        hash.add(blob.radius);
        hash.add(blob.crossSection);
        hash.add(blob.source);
        hash.add(blob.albedo);
        hash.add(blob.anisotropy);
        hash.add(blob.fireShare);
        hash.add(double(blob.layer));
        digest.isUsable = digest.isUsable && isUsable(blob);
    }
    digest.hash = hash.value();
    return digest;
}

/// Of all blobs, part by part on all threads.
std::vector<BlobDigest> digestsOf(std::span<const MediumBlob> blobs, base::TaskRunner& tasks)
{
    constexpr size_t kPart = 4096;
    std::vector<BlobDigest> digests((blobs.size() + kPart - 1) / kPart);
    tasks.parallelFor(uint32_t(digests.size()), 1, [&](uint32_t first, uint32_t last) {
        for (size_t part = first; part < last; ++part)
            digests[part] =
                digestOf(blobs.subspan(part * kPart, std::min(kPart, blobs.size() - part * kPart)));
    });
    return digests;
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
    for (const double number : {double(b.width), double(b.height), double(b.panorama),
                                double(scene.lighting.groundAlbedo), double(scene.isEmpty)})
        hash.add(number);
    for (const EffectLight& light : scene.lights) {
        hash.add(light.position);
        hash.add(glm::dvec3(light.intensity));
        hash.add(double(light.radius));
    }
}

uint64_t keyOf(const ReferenceScene& scene, const std::vector<BlobDigest>& blobs, const ReferenceSettings& s)
{
    KeyHash hash;
    for (const BlobDigest& part : blobs)
        hash.addWord(part.hash);
    addOpaque(hash, scene.opaque);
    const ReferenceCamera& c = scene.camera;
    for (const glm::dvec3& v : {c.eye, c.right, c.up, c.forward})
        hash.add(v);
    for (const double number :
         {double(c.orthographic), c.halfHeight, c.nearDistance, double(s.width), double(s.height),
          double(s.samples), s.exposure, double(s.isSingle), double(s.scattering), double(s.integral.model),
          double(s.integral.degree), double(s.integral.scheme.method), double(s.integral.scheme.count),
          s.integral.scheme.cap, s.integral.scheme.step, s.integral.scheme.tolerance,
          s.integral.scheme.stopDepth})
        hash.add(number);
    return hash.value();
}

base::Status check(const std::vector<BlobDigest>& blobs, const ReferenceSettings& s)
{
    const auto refused = [](const char* what) { return base::Status(base::Code::InvalidArgument, what); };
    if (s.width < 1 || s.height < 1 || s.width > kMaxSize || s.height > kMaxSize)
        return refused("width and height must be 1..16384");
    if (s.samples < 1 || s.samples > kMaxSamples)
        return refused("samples must be 1..16");
    if (!std::all_of(blobs.begin(), blobs.end(), [](const BlobDigest& part) { return part.isUsable; }))
        return refused("a blob's numbers must be finite, its radius positive, the others not negative");
    return {};
}

/// Makes the axes exactly as long as formulas assume.
base::Status checkCamera(ReferenceCamera& io)
{
    for (glm::dvec3* axis : {&io.right, &io.up, &io.forward}) {
        const auto unit = unitDirection({axis->x, axis->y, axis->z});
        if (!unit.ok())
            return {base::Code::InvalidArgument, "the camera's axes must be finite and not 0"};
        *axis = {(*unit)[0], (*unit)[1], (*unit)[2]};
    }
    if (!base::isFinite(io.eye.x + io.eye.y + io.eye.z) || !base::isFinite(io.halfHeight) ||
        !(io.halfHeight > 0.0) || !base::isFinite(io.nearDistance) || !(io.nearDistance >= 0.0))
        return {base::Code::InvalidArgument,
                "the camera's eye must be finite, its height above 0 and its near distance at least 0"};
    return {};
}

} // namespace

base::Status ReferenceRenderer::build(const ReferenceScene& scene, const ReferenceSettings& settings,
                                      base::TaskRunner& tasks)
{
    const std::vector<BlobDigest> digests = digestsOf(scene.blobs, tasks);
    if (base::Status status = check(digests, settings); !status)
        return status;
    picture_.camera = scene.camera;
    if (base::Status status = checkCamera(picture_.camera); !status)
        return status;
    tasks_ = &tasks;
    key_ = keyOf(scene, digests, settings);
    picture_.settings = settings;
    picture_.medium.build(scene.blobs, scene.camera.eye, tasks);
    picture_.opaque.build(scene.opaque, scene.camera.eye, tasks);
    if (settings.scattering != ScatteringMode::None)
        picture_.medium.setScattered(lightAtCenters(picture_.medium, picture_.opaque,
                                                    settings.scattering == ScatteringMode::Centers, tasks));
    edge_ = settings.samples == 1 ? 16 : 8;
    tilesX_ = uint32_t((settings.width + edge_ - 1) / edge_);
    tilesY_ = uint32_t((settings.height + edge_ - 1) / edge_);
    const size_t pixels = size_t(settings.width) * size_t(settings.height);
    planes_.assign(reference_channel::Count, std::vector<float>(pixels, 0.0f));
    isDone_.assign(tileCount(), 0);
    idle_.clear();
    done_ = 0;
    work_ = {};
    status_ = {};
    return {};
}

PixelBlock ReferenceRenderer::blockOf(uint32_t tile) const
{
    const int x = int(tile % tilesX_) * edge_;
    const int y = int(tile / tilesX_) * edge_;
    return {x, y, std::min(x + edge_, picture_.settings.width),
            std::min(y + edge_, picture_.settings.height)};
}

void ReferenceRenderer::place(uint32_t tile, std::span<const float> values)
{
    const PixelBlock block = blockOf(tile);
    size_t from = 0;
    for (int y = block.y0; y < block.y1; ++y)
        for (int x = block.x0; x < block.x1; ++x)
            for (std::vector<float>& plane : planes_)
                plane[size_t(y) * size_t(picture_.settings.width) + size_t(x)] = values[from++];
    isDone_[tile] = 1;
}

void ReferenceRenderer::restore(uint32_t tile, std::span<const float> values)
{
    if (tile >= tileCount() || isDone_[tile])
        return;
    const PixelBlock block = blockOf(tile);
    const size_t pixels = size_t(block.x1 - block.x0) * size_t(block.y1 - block.y0);
    if (values.size() != pixels * reference_channel::Count)
        return;
    place(tile, values);
    ++done_;
}

std::unique_ptr<TileRenderer> ReferenceRenderer::borrow()
{
    const std::lock_guard lock(mutex_);
    if (idle_.empty())
        return std::make_unique<TileRenderer>(picture_);
    std::unique_ptr<TileRenderer> renderer = std::move(idle_.back());
    idle_.pop_back();
    return renderer;
}

void ReferenceRenderer::giveBack(std::unique_ptr<TileRenderer> renderer)
{
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(renderer));
}

void ReferenceRenderer::stop()
{
    const std::lock_guard lock(mutex_);
    if (status_.ok())
        status_ = {base::Code::Interrupted, "interrupted"};
}

void ReferenceRenderer::renderTile(uint32_t tile, TileJournal* journal, const Callbacks& callbacks)
{
    if (callbacks.shouldStop && callbacks.shouldStop())
        stop();
    {
        const std::lock_guard lock(mutex_);
        if (!status_.ok())
            return;
    }
    const PixelBlock block = blockOf(tile);
    std::vector<float> values(size_t(block.x1 - block.x0) * size_t(block.y1 - block.y0) *
                              reference_channel::Count);
    std::unique_ptr<TileRenderer> renderer = borrow();
    const bool isWhole = renderer->render(block, values, callbacks.shouldStop);
    giveBack(std::move(renderer));
    if (!isWhole)
        return stop();
    place(tile, values);
    base::Status written = journal ? journal->append(tile, values) : base::Status();
    const std::lock_guard lock(mutex_);
    ++done_;
    if (status_.ok() && !written.ok())
        status_ = std::move(written);
    if (callbacks.progress)
        callbacks.progress(done_, tileCount());
}

base::Status ReferenceRenderer::render(TileJournal* journal, const Callbacks& callbacks)
{
    status_ = {};
    tasks_->parallelFor(tileCount(), 1, [&](uint32_t begin, uint32_t end) {
        for (uint32_t tile = begin; tile < end; ++tile)
            if (!isDone_[tile])
                renderTile(tile, journal, callbacks);
    });
    for (const auto& renderer : idle_)
        work_ += renderer->work();
    idle_.clear();
    return status_;
}

std::vector<float> ReferenceRenderer::interleaved(uint32_t first) const
{
    std::vector<float> result(planes_[first].size() * 4);
    for (size_t i = 0; i < planes_[first].size(); ++i)
        for (uint32_t c = 0; c < 4; ++c)
            result[4 * i + c] = planes_[first + c][i];
    return result;
}

} // namespace fx::render
