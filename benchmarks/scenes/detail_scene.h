/// @file detail_scene.h
/// Effects of the library whose fields have detail, at one time, filling the view; their pictures by OpenGL
/// and by the ray integral. Without background, glare and shimmer.
///
/// Threads: the creating thread, which is the GL thread of its pictures.
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
    const char* preset; ///< of the library
    double time;        ///< [s]
    double height;      ///< [m] of the middle of the picture above the ground
    double half;        ///< [m] half of the picture's side
    double first, last; ///< [s] times between which its extinction is followed
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
    /// @param time [s] that is shown first
    static base::Result<std::unique_ptr<DetailScene>> create(const DetailSubject& subject, double time);

    /// Another moment, not before the last one. @param time [s]
    base::Status show(double time);
    /// Of the moment, until the next show().
    const SceneMoment& moment() const { return moment_; }
    const base::SnapshotSchema& schema() const { return moment_.snapshots.newer->schema(); }
    /// Square pictures.
    render::ReferenceCamera camera(bool isParallel = false) const;
    /// For the renderers without a GPU. @param octaves of the detail; 0: smooth
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

/// [1] of each pixel, rows from the top: optical depth by the ray integral, see DetailedRay.
/// @param side [pixel]  @param pixels [pixel] of the picture whose pixels the detail is made for
std::vector<float> integratedDepth(const render::ReferenceScene& scene, int side, int pixels);

} // namespace fx::cli
