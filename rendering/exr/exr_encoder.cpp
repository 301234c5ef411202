#include "rendering/exr/exr_encoder.h"

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfThreading.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <new>
#include <set>
#include <thread>

namespace fx::render {
namespace {

constexpr int kMaxSize = 16384;
constexpr float kHalfMax = 65504.0f;
constexpr uint32_t kMaxThreads = 256;

/// OpenEXR's output into a string; the library seeks back to fill in its table of offsets.
class MemoryStream final : public Imf::OStream
{
public:
    MemoryStream() : Imf::OStream("memory") {}

    void write(const char bytes[], int count) override
    {
        const size_t size = size_t(count);
        if (bytes_.size() < position_ + size)
            bytes_.resize(position_ + size);
        std::memcpy(bytes_.data() + position_, bytes, size);
        position_ += size;
    }
    uint64_t tellp() override { return position_; }
    void seekp(uint64_t position) override { position_ = size_t(position); }

    std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
    size_t position_ = 0;
};

base::Status invalid(const std::string& message)
{
    return {base::Code::InvalidArgument, "EXR: " + message};
}

base::Status check(const ExrImage& image)
{
    if (image.width < 1 || image.height < 1 || image.width > kMaxSize || image.height > kMaxSize)
        return invalid("size " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                       " is outside 1..16384");
    if (image.channels.empty())
        return invalid("no channels");
    const size_t pixels = size_t(image.width) * size_t(image.height);
    std::set<std::string> names;
    for (const ExrChannel& channel : image.channels) {
        if (channel.name.empty() || channel.name.size() > 255)
            return invalid("a channel's name must have 1 to 255 bytes");
        if (!names.insert(channel.name).second)
            return invalid("two channels are called " + channel.name);
        if (channel.stride < 1 || channel.values.size() < channel.offset + (pixels - 1) * channel.stride + 1)
            return invalid("channel " + channel.name + " has fewer values than the image has pixels");
    }
    return {};
}

Imf::PixelType pixelType(ExrPrecision precision)
{
    switch (precision) {
    case ExrPrecision::Half:
        return Imf::HALF;
    case ExrPrecision::Float:
        return Imf::FLOAT;
    case ExrPrecision::Whole:
        return Imf::UINT;
    }
    return Imf::FLOAT;
}

Imf::Header headerOf(const ExrImage& image)
{
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::addChromaticities(header, Imf::Chromaticities()); // the default is Rec. 709
    if (image.whiteLuminance > 0.0f)
        Imf::addWhiteLuminance(header, image.whiteLuminance);
    for (const ExrChannel& channel : image.channels) {
        header.channels().insert(channel.name, Imf::Channel(pixelType(channel.precision)));
    }
    return header;
}

std::vector<Imath::half> toHalf(const ExrChannel& channel, size_t pixels)
{
    std::vector<Imath::half> result(pixels);
    for (size_t i = 0; i < pixels; ++i) {
        const float value = channel.values[channel.offset + i * channel.stride];
        result[i] = Imath::half(std::isfinite(value) ? std::clamp(value, -kHalfMax, kHalfMax) : value);
    }
    return result;
}

std::vector<uint32_t> toWhole(const ExrChannel& channel, size_t pixels)
{
    constexpr float kMax = 16777216.0f; // 2^24, up to where floats hold all whole numbers
    std::vector<uint32_t> result(pixels);
    for (size_t i = 0; i < pixels; ++i) {
        const float value = channel.values[channel.offset + i * channel.stride];
        result[i] = value > 0.0f ? uint32_t(std::lround(std::min(value, kMax))) : 0u; // NaN is 0
    }
    return result;
}

std::string encode(const ExrImage& image, int threads)
{
    if (Imf::globalThreadCount() < threads)
        Imf::setGlobalThreadCount(threads);
    const size_t pixels = size_t(image.width) * size_t(image.height);
    std::vector<std::vector<Imath::half>> halves; // lives until the file is complete
    halves.reserve(image.channels.size());
    std::vector<std::vector<uint32_t>> wholes; // likewise
    wholes.reserve(image.channels.size());
    Imf::FrameBuffer frame;
    for (const ExrChannel& channel : image.channels) {
        if (channel.precision == ExrPrecision::Half) {
            halves.push_back(toHalf(channel, pixels));
            frame.insert(channel.name,
                         Imf::Slice(Imf::HALF, reinterpret_cast<char*>(halves.back().data()),
                                    sizeof(Imath::half), sizeof(Imath::half) * size_t(image.width)));
        } else if (channel.precision == ExrPrecision::Whole) {
            wholes.push_back(toWhole(channel, pixels));
            frame.insert(channel.name, Imf::Slice(Imf::UINT, reinterpret_cast<char*>(wholes.back().data()),
                                                  sizeof(uint32_t), sizeof(uint32_t) * size_t(image.width)));
        } else {
            // OpenEXR only reads from the pointer, but its type serves readers too.
            char* first = reinterpret_cast<char*>(const_cast<float*>(channel.values.data() + channel.offset));
            const size_t step = sizeof(float) * channel.stride;
            frame.insert(channel.name, Imf::Slice(Imf::FLOAT, first, step, step * size_t(image.width)));
        }
    }
    MemoryStream stream;
    {
        Imf::OutputFile file(stream, headerOf(image), threads);
        file.setFrameBuffer(frame);
        file.writePixels(image.height);
    } // the destructor writes the table of offsets
    return stream.take();
}

} // namespace

void addRgba(ExrImage& image, const std::string& layer, std::span<const float> rgba, ExrPrecision precision)
{
    const std::string prefix = layer.empty() ? "" : layer + ".";
    const char* const names[] = {"R", "G", "B", "A"};
    for (size_t i = 0; i < 4; ++i)
        image.channels.push_back({prefix + names[i], rgba, i, 4, precision});
}

void addPlane(ExrImage& image, const std::string& name, std::span<const float> values, ExrPrecision precision)
{
    image.channels.push_back({name, values, 0, 1, precision});
}

base::Result<std::string> encodeExr(const ExrImage& image, uint32_t threads)
{
    if (base::Status status = check(image); !status)
        return status;
    try {
        const uint32_t wanted = threads > 0 ? threads : std::thread::hardware_concurrency();
        return encode(image, int(std::clamp(wanted, 1u, kMaxThreads)));
    } catch (const std::bad_alloc&) {
        return base::Status(base::Code::OutOfMemory, "EXR: out of memory");
    } catch (const std::exception& error) {
        return base::Status(base::Code::Internal, std::string("EXR: ") + error.what());
    }
}

} // namespace fx::render
