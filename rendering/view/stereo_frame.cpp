// A frame of two eyes.
#include "rendering/view/view_parts.h"

#include <utility>

namespace fx::render {

namespace {

/// Ends a frame of two eyes.
class StereoEnd
{
public:
    StereoEnd(StereoFrame& stereo, TimingClock& clock) : stereo_(stereo), clock_(clock), asked_(clock) {}
    ~StereoEnd()
    {
        stereo_.otherCamera = nullptr;
        stereo_.isSecond = stereo_.hasLists = false;
        clock_ = asked_;
    }
    StereoEnd(const StereoEnd&) = delete;
    StereoEnd& operator=(const StereoEnd&) = delete;

private:
    StereoFrame& stereo_;
    TimingClock& clock_;
    const TimingClock asked_;
};

/// Adds what the first eye has cost to the counters of the second.
void addCosts(const FrameStatistics& first, FrameStatistics& io)
{
    io.passes += first.passes;
    io.glCalls += first.glCalls;
    io.drawCalls += first.drawCalls;
    io.programsCompiled += first.programsCompiled;
    io.uploadedBytes += first.uploadedBytes;
    io.sortedElements += first.sortedElements;
}

} // namespace

base::Status ViewRenderer::renderStereo(const base::SnapshotPair& snapshots, const FrameRequest& first,
                                        const FrameRequest& second)
{
    Impl& s = *impl_;
    if (settings_.layerOutputs || settings_.outputs != 0)
        return {base::Code::InvalidArgument,
                "settings.layerOutputs and settings.outputs are textures of one eye: set them to 0, or "
                "call fxView_Render for each eye"};
    FrameRequest other = second;
    other.interpolation = first.interpolation;
    other.time = first.time;
    other.deltaTime = 0.0; // the eyes adapt once
    other.resetHistory = first.resetHistory;
    for (const FrameRequest* request : {&std::as_const(other), &first}) {
        if (base::Status status = checkAll(*request); !status)
            return status;
        if (s.leavesPictureAlone(snapshots, *request, settings_))
            continue;
        if (base::Status status = s.checkTargets(*request); !status)
            return status;
    }
    s.dropPrepared();
    const CameraGeometry otherCamera = cameraGeometry(other.camera);
    const StereoEnd end(s.stereo, s.clock);
    s.stereo.otherCamera = &otherCamera;
    if (base::Status status = render(snapshots, first); !status)
        return status;
    const FrameStatistics statistics = statistics_;
    s.stereo.otherCamera = nullptr;
    s.stereo.isSecond = true;
    s.clock = TimingClock::Off;
    base::Status status = render(snapshots, other);
    addCosts(statistics, statistics_);
    return status;
}

} // namespace fx::render
