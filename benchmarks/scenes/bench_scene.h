/// @file bench_scene.h
/// Scenes of the C API, with or without a view, for benchmarks of the cost of instances.
///
/// Threads: only the thread that created the object.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/fxsdk.h"
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/platform/gl_context.h"

#include <memory>
#include <string>
#include <vector>

namespace fx::cli {

class BenchScene
{
public:
    struct Options
    {
        bool gl = false;
        bool culling = true;
        int pixels = 256;    ///< [pixel] width and height of the picture
        bool warmsUp = true; ///< false: the first frames compile the programs that they need
    };
    static base::Result<std::unique_ptr<BenchScene>> create(const Options& options);
    ~BenchScene();
    BenchScene(const BenchScene&) = delete;
    BenchScene& operator=(const BenchScene&) = delete;

    base::Result<FxPresetId> load(const std::string& preset);
    base::Result<FxPresetId> loadLibrary(const char* name);
    base::Status add(FxPresetId preset, double x, double z, uint64_t seed, int64_t startTick);
    /// Sets a camera 2 m above the origin that looks horizontally, with a field of view of 40 degrees. @param
    /// radians direction; 0 is along -Z
    base::Status look(double radians);
    /// Sets the position of the camera of draw(). The simulation does not depend on the position.
    void moveTo(double x, double y, double z);
    base::Status setView(const FxViewSettings& settings);
    /// Switches the update of levels of detail off or on.
    /// @param isHeld true: the next frames keep the levels of detail of the last frame, until setView() or a
    ///          call with false
    void holdDetail(bool isHeld);
    base::Status update();
    base::Status draw();          ///< does nothing without GL
    void finish();                ///< waits for the GPU
    void clear();                 ///< clears the picture to black before draw()
    void clearPicture();          ///< clears the picture to a uniform gray
    std::vector<float> picture(); ///< RGBA, row by row; empty without GL
    uint64_t bytesInUse() const;  ///< [byte] memory that the context uses
    FxFrameStats frameStats() const;
    void remove(size_t index); ///< @param index in instances()

    FxScene* scene() const { return scene_; }
    FxView* view() const { return view_; }                ///< null without GL
    const FxFrameDef& frameDef() const { return frame_; } ///< definition of the view's next frame
    const std::vector<FxInstanceId>& instances() const { return instances_; }
    FxSceneStatistics statistics() const;
    FxViewStatistics viewStatistics() const;
    std::string renderer() const { return device_ ? device_->limits().renderer : ""; }

private:
    BenchScene() = default;
    base::Status start(const Options& options);
    base::Status startGl();

    Options options_;
    std::unique_ptr<render::GlContext> gl_;
    std::unique_ptr<render::GlDevice> device_;
    render::GlTexture color_;
    FxContext* context_ = nullptr;
    FxScene* scene_ = nullptr;
    FxView* view_ = nullptr;
    FxFrameDef frame_{};
    std::vector<FxInstanceId> instances_;
};

} // namespace fx::cli
