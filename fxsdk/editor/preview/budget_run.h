/// @file budget_run.h
/// Measures an effect on this machine piece by piece, so that the editor stays alive meanwhile.
///
/// Threads: the GL thread.
#pragma once

#include "fxsdk/editor/preview/preview.h"
#include "fxsdk/editor/session/budget_report.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace fx::editor {

/// What is measured.
struct BudgetSubject
{
    std::string text; ///< of the document as it is shown
    std::string name; ///< of its file
    DocumentKind kind = DocumentKind::Preset;
    std::string empty; ///< text with all elements hidden; presets only
    /// Texts that show one element each, by its pointer; presets only.
    std::vector<std::pair<std::string, std::string>> elements;
    /// Texts without the elements of a technique each, by its pointer; presets only.
    std::vector<std::pair<std::string, std::string>> techniques;
    double time = 0.0; ///< [s] of the picture
    double end = 5.0;  ///< [s] of the timeline
    PreviewFrame frame;
    MotionChoice motion;
};

class BudgetRun
{
public:
    static constexpr size_t kMostElements = 64; ///< that are measured

    /// @param loader functions of the current OpenGL context
    static base::Result<std::unique_ptr<BudgetRun>> create(const render::GlLoader& loader,
                                                           BudgetSubject subject);
    ~BudgetRun();
    BudgetRun(const BudgetRun&) = delete;
    BudgetRun& operator=(const BudgetRun&) = delete;

    /// Measures the next piece. @return what has failed; the run is then done
    base::Status step();
    bool isDone() const { return next_ >= pieces_; }
    double progress() const { return double(next_) / double(pieces_); } ///< [0, 1]
    /// What has been measured so far. Its textures live as long as this object.
    const BudgetReport& report() const { return report_; }

private:
    BudgetRun(std::unique_ptr<Preview> preview, BudgetSubject subject);
    base::Status measure(size_t piece);
    /// Times of a text, and the half of the range of their sum.
    struct Sample
    {
        StageTimes times;
        double range = 0.0; ///< [ms]
        uint32_t particles = 0;
    };
    base::Status measureText(const std::string& text, const PreviewFrame& frame, Sample& out);
    size_t partPieces() const;
    base::Status measurePart(size_t piece);
    static PartCost costOf(const std::string& pointer, const Sample& with, const Sample& without);
    void addDrift(const Sample& all);
    base::Status measureQuality(size_t level);
    base::Status measureMoment(size_t moment);

    std::shared_ptr<render::GlDevice> device_; ///< of the textures of the report
    std::unique_ptr<Preview> preview_;         ///< until the run is done
    BudgetSubject subject_;
    BudgetReport report_;
    Sample none_; ///< without any element
    Sample all_;  ///< the whole effect
    size_t pieces_;
    size_t next_ = 0;
};

} // namespace fx::editor
