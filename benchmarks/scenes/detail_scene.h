/// @file detail_scene.h
/// Effects of the library with detail of the field, at one time, filling the view. Their pictures are
/// computed by OpenGL and by the ray integral, without background, glare and shimmer.
///
/// Threads: only the thread that created the object, which is the GL thread of its pictures.
#pragma once

#include "fxsdk/cli/render/snapshot_renderer.h"
#include "fxsdk/scene_file/scene_file.h"
#include "rendering/reference/render/reference_scene.h"

#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace fx::cli {

/// Subject of the pictures.
struct DetailSubject
{
    std::string_view name;
    const char* preset; ///< name of a preset of the library
    double time;        ///< [s]
    double height;      ///< [m] height of the picture's center above the ground
    double half;        ///< [m] half of the side length of the picture
    double first, last; ///< [s] range of times in which the extinction of the effect is measured
};

/// All subjects.
std::span<const DetailSubject> detailSubjects();

class DetailScene
{
public:
    static base::Result<std::unique_ptr<DetailScene>> create(const DetailSubject& subject)
    {
        return create(subject, subject.time);
    }
    /// Creates the scene of a subject at a time.
    /// @param time [s] time to be shown first
    static base::Result<std::unique_ptr<DetailScene>> create(const DetailSubject& subject, double time);

    /// Advances to another time. @param time [s] not before the last time
    base::Status show(double time);
    /// The present moment; valid until the next show().
    const SceneMoment& moment() const { return moment_; }
    const base::SnapshotSchema& schema() const { return moment_.snapshots.newer->schema(); }
    /// Camera of square pictures.
    render::ReferenceCamera camera(bool isParallel = false) const;
    /// Scene for the renderers without a GPU. @param octaves number of octaves of the detail; 0: smooth
    render::ReferenceScene reference(int octaves) const;
    const DetailSubject& subject() const { return subject_; }

private:
    explicit DetailScene(const DetailSubject& subject) : subject_(subject) {}

    DetailSubject subject_;
    scene_file::SceneFile file_;
    std::unique_ptr<EffectScene> effects_;
    SceneMoment moment_;
};

/// Settings of a view in daylight without post-processing.
render::ViewSettings detailViewSettings();

/// [1] Optical depth of each pixel by the ray integral, rows from the top, see DetailedRay.
/// @param side [pixel] side length of the picture
/// @param pixels number of pixels per side that determines the pixel width for the fading of fine detail
std::vector<float> integratedDepth(const render::ReferenceScene& scene, int side, int pixels);

} // namespace fx::cli
