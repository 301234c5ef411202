#include "rendering/gl/gl_pass_timer.h"

#include <chrono>

namespace fx::render {

double steadyMilliseconds()
{
    using namespace std::chrono;
    return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

GlPassTimer::~GlPassTimer()
{
    for (Frame& frame : frames_)
        if (frame.queries[0] != 0)
            device_.gl.DeleteQueries(GLsizei(kStamps), frame.queries.data());
}

bool GlPassTimer::hasGpuClock()
{
    if (counterBits_ < 0) {
        GLint bits = 0;
        device_.gl.GetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
        counterBits_ = bits;
    }
    return counterBits_ > 0;
}

void GlPassTimer::beginFrame(TimingClock clock, uint64_t tag)
{
    open_ = nullptr;
    if (clock == TimingClock::Off || waiting_ == kFrames || (clock == TimingClock::Gpu && !hasGpuClock()))
        return; // not measured
    Frame& frame = frames_[(first_ + waiting_) % kFrames];
    if (clock == TimingClock::Gpu && frame.queries[0] == 0)
        device_.gl.CreateQueries(GL_TIMESTAMP, GLsizei(kStamps), frame.queries.data());
    frame.stamps = 0;
    frame.tag = tag;
    frame.clock = clock;
    open_ = &frame;
    group_ = 0;
    if (clock == TimingClock::Host)
        stamp(0); // what the processor prepares counts
}

void GlPassTimer::beginPasses()
{
    if (open_ && open_->clock == TimingClock::Gpu)
        stamp(0);
}

void GlPassTimer::beginPass(std::string_view name)
{
    const size_t group = open_ ? groups_.groupOf(name) : 0;
    if (open_ && group != group_ && open_->stamps + 1 < kStamps)
        stamp(group);
}

void GlPassTimer::endFrame(bool succeeded)
{
    if (open_ && open_->stamps > 0 && succeeded) {
        stamp(0);
        ++waiting_;
    }
    open_ = nullptr;
}

void GlPassTimer::stamp(size_t next)
{
    Frame& frame = *open_;
    if (frame.clock == TimingClock::Gpu) {
        device_.gl.QueryCounter(frame.queries[frame.stamps], GL_TIMESTAMP);
    } else {
        if (frame.stamps > 0)
            device_.gl.Finish();
        frame.host[frame.stamps] = hostClock();
    }
    frame.groups[frame.stamps++] = next;
    group_ = next;
}

bool GlPassTimer::isAvailable(const Frame& frame)
{
    if (frame.clock == TimingClock::Host)
        return true;
    GLuint available = 0; // the last stamp is the last to come
    device_.gl.GetQueryObjectuiv(frame.queries[frame.stamps - 1], GL_QUERY_RESULT_AVAILABLE, &available);
    return available != 0;
}

/// Reads the times of the stamps.
/// @return false if GL has none: queries of a lost context are available at once, with the result 0
bool GlPassTimer::read(const Frame& frame, std::array<double, kStamps>& out)
{
    out = frame.host;
    for (size_t i = 0; frame.clock == TimingClock::Gpu && i < frame.stamps; ++i) {
        GLuint64 nanoseconds = 0;
        device_.gl.GetQueryObjectui64v(frame.queries[i], GL_QUERY_RESULT, &nanoseconds);
        if (nanoseconds == 0)
            return false;
        out[i] = double(nanoseconds) * 1e-6;
    }
    return true;
}

bool GlPassTimer::take(GroupTimes& out)
{
    while (waiting_ > 0 && isAvailable(frames_[first_])) {
        const Frame& frame = frames_[first_];
        first_ = (first_ + 1) % kFrames;
        --waiting_;
        std::array<double, kStamps> at{};
        if (!read(frame, at))
            continue;
        out = {frame.tag, {}};
        for (size_t i = 0; i + 1 < frame.stamps; ++i)
            out.milliseconds[frame.groups[i]] += at[i + 1] - at[i];
        return true;
    }
    return false;
}

} // namespace fx::render
