/// @file card_picture.h
/// Draws pictures of blobs (Card) by OpenGL along parallel rays, in the same way as views draw blobs. The
/// pictures are compared with the ray integral.
///
/// Threads: only the thread that created the object.
#pragma once

#include "benchmarks/scenes/cards.h"
#include "foundation/snapshot/frame_snapshot.h"
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/platform/gl_context.h"
#include "rendering/view/view_renderer.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace fx::cli {

class CardPicture
{
public:
    static constexpr float kFarthest = 40.0f; ///< [m] largest distance of a surface

    /// Creates a renderer of pictures.
    /// @param width, height [pixel] size of pictures
    /// @param field [m] width of the scene in the picture
    static base::Result<std::unique_ptr<CardPicture>> create(int width, int height, float field);

    /// Settings of the view; initially without procedural detail and glare, at EV 0.
    render::ViewSettings& settings() { return view_->settings(); }
    const render::FrameStatistics& statistics() const { return view_->statistics(); }
    const std::string& renderer() const { return device_->limits().renderer; }
    const base::SnapshotSchema& schema() const { return schema_; }

    /// Creates a snapshot of cards. The coordinate z of a card is its distance from the eye along the view
    /// direction. Each snapshot has a new number, because a view reuses the data of a snapshot with an equal
    /// number.
    base::FrameSnapshot snapshotOf(std::span<const Card> cards) const;

    /// Sets the distance [m] of an opaque surface for each pixel, rows from the bottom; +inf, or above
    /// kFarthest: none.
    void setSurface(std::span<const float> distances);
    void clear();
    /// Draws over the present picture. @param outMilliseconds [ms] time until the GPU has finished; null: the
    /// call does not wait
    base::Status draw(const base::FrameSnapshot& snapshot, double* outMilliseconds = nullptr);
    /// Luminance as RGB, rows from the bottom.
    std::vector<float> read();

private:
    CardPicture(int width, int height, float field) : width_(width), height_(height), field_(field) {}

    int width_, height_;
    float field_;
    std::unique_ptr<render::GlContext> gl_;
    std::unique_ptr<render::GlDevice> device_;
    render::GlTexture color_, depth_;
    bool hasSurface_ = false;
    base::SnapshotSchema schema_;
    std::unique_ptr<render::ViewRenderer> view_;
};

} // namespace fx::cli
