// Buffers and textures that belong to a view: made when they are called for, given back after a while without
// use.
#include "rendering/view/view_parts.h"

#include <algorithm>
#include <bit>

namespace fx::render {

namespace {

constexpr uint32_t kIdleFrames = 300; ///< until textures and buffers are given back
constexpr size_t kLeastBufferBytes = 4096;

} // namespace

/// Such a buffer belongs to the view, so that what is in it is still there in the next frame.
base::Status ViewRenderer::Impl::makeRoom(GlBuffer& buffer, size_t bytes, const char* label)
{
    if (bytes == 0)
        return {};
    if (buffer.bytes() >= bytes) {
        device->gl.InvalidateBufferData(buffer.name()); // the GPU may still read it: do not wait
        return {};
    }
    auto created = GlBuffer::create(*device, std::bit_ceil(std::max(bytes, kLeastBufferBytes)), label);
    if (!created)
        return created.status();
    buffer = std::move(*created);
    return {};
}

base::Status ViewRenderer::Impl::makeRoomForImpostors()
{
    if (base::Status status = makeRoom(impostorBuffer, builder.impostors().size_bytes(), "impostors");
        !status)
        return status;
    if (builder.takenTiles().empty() || impostorAtlas.name() != 0)
        return {};
    auto created = GlTexture::create(*device, kImpostorColumns * kImpostorTile, kImpostorRows * kImpostorTile,
                                     glInternalFormat(Format::RGBA16F), "impostors");
    if (!created)
        return created.status();
    impostorAtlas = std::move(*created);
    return {};
}

/// A frame in which there is nothing to draw.
FrameStatistics ViewRenderer::Impl::rest()
{
    outputs = {};
    historyFresh = true; // glare that has paused begins anew
    FrameStatistics statistics;
    const uint64_t before = device->callCount();
    if (++idleFrames >= kIdleFrames && backend.pooledBytes() > 0)
        backend.releasePool();
    if (idleFrames == kIdleFrames) {
        releaseBlobs();
        releaseImpostors();
        key.reset();
    }
    single.buffers.idle();
    joined.buffers.idle();
    statistics.glCalls = device->callCount() - before;
    statistics.textureBytes = backend.pooledBytes() + single.buffers.bytes() + joined.buffers.bytes();
    return statistics;
}

bool ViewRenderer::Impl::holdsNothing() const
{
    return backend.pooledBytes() == 0 && single.buffers.bytes() == 0 && joined.buffers.bytes() == 0 &&
           blobBuffer.name() == 0 && impostorBuffer.name() == 0 && impostorAtlas.name() == 0 && !key;
}

void ViewRenderer::Impl::releaseBlobs()
{
    blobBuffer = {};
}

void ViewRenderer::Impl::releaseImpostors()
{
    impostorBuffer = {};
    impostorAtlas = {};
    builder.forgetPictures();
}

/// Gives back what many frames in a row have drawn nothing from.
void ViewRenderer::Impl::releaseUnused()
{
    blobsUnused = builder.blobs().empty() ? blobsUnused + 1 : 0;
    if (blobsUnused == kIdleFrames)
        releaseBlobs();
    impostorsUnused = builder.impostors().empty() ? impostorsUnused + 1 : 0;
    if (impostorsUnused == kIdleFrames)
        releaseImpostors();
}

} // namespace fx::render
