#include "fxsdk/cli/render/blob_list_renderer.h"

#include "fxsdk/cli/render/blob_snapshot.h"

#include <optional>

namespace fx::cli {

struct BlobListRenderer::Impl
{
    Impl() { schema.add(base::kBlobKind); }

    base::SnapshotSchema schema;
    std::unique_ptr<SnapshotRenderer> renderer;
    std::optional<base::FrameSnapshot> snapshot;
    uint64_t sequence = 0; ///< of the snapshot
};

BlobListRenderer::BlobListRenderer() : impl_(std::make_unique<Impl>()) {}
BlobListRenderer::~BlobListRenderer() = default;

base::Result<std::unique_ptr<BlobListRenderer>>
BlobListRenderer::create(std::span<const render::MediumBlob> blobs, const render::ViewSettings& settings,
                         int width, int height)
{
    std::unique_ptr<BlobListRenderer> made(new BlobListRenderer());
    auto renderer = SnapshotRenderer::create(made->impl_->schema, settings, width, height);
    if (!renderer.ok())
        return renderer.status();
    made->impl_->renderer = std::move(*renderer);
    made->show(blobs);
    return made;
}

void BlobListRenderer::show(std::span<const render::MediumBlob> blobs)
{
    impl_->snapshot.emplace(snapshotOfBlobs(blobs, impl_->schema, ++impl_->sequence));
}

SnapshotRenderer& BlobListRenderer::pictures()
{
    return *impl_->renderer;
}

base::Status BlobListRenderer::render(const render::ReferenceCamera& camera, double time)
{
    return impl_->renderer->render({{&*impl_->snapshot, nullptr}, 1.0}, camera, time);
}

} // namespace fx::cli
