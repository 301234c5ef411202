/// @file host_target_fixture.h
/// The burning scene of ViewApiTest drawn into textures of the host's choice, each compared with the picture
/// that an RGBA32F texture with the same light in it gets.
#pragma once

#include "tests/api/host_textures.h"
#include "tests/api/view_fixture.h"

#include <string>
#include <vector>

namespace fx::test {

/// How a format stores light, for what may be expected of a picture in it.
struct ColorFormat
{
    GLenum format;
    const char* name;
    enum class Kind
    {
        Refused,
        Unorm,
        Snorm,
        Float,
        Srgb,
    } kind;
    double step;      ///< Unorm, Srgb: one code; Float: relative distance of neighbors
    double alphaStep; ///< the same of alpha; 0: has none
};

struct Outcome
{
    FxResult result;
    std::string words; ///< of a refusal
};

double srgbDecoded(double code);
double srgbEncoded(double light);

class HostTargetTest : public ViewApiTest
{
protected:
    HostTargetTest();

    /// Nothing but media over the picture, blended into it where it lies; otherwise glare and shimmer as
    /// well, which make a picture of their own that is written back.
    void useSettings(bool inPlace, bool toneMap = false);
    Outcome render(const FxFrameDef& def);

    /// The middle of the picture covers all of [0, 1], its corner is not reached by media.
    std::vector<float> gradient() const;
    void write(GLuint texture, const std::vector<float>& rgba);
    std::vector<float> read(GLuint texture); ///< RGBA as stored
    /// What `stored` codes mean.
    static std::vector<float> lightOf(const ColorFormat& format, std::vector<float> stored);
    /// The picture of the frame in RGBA32F over `light`.
    std::vector<float> reference(FxFrameDef def, const std::vector<float>& light);
    /// Compares what is stored with the reference picture.
    std::string faultOf(const ColorFormat& format, const std::vector<float>& stored,
                        const std::vector<float>& expected) const;
    /// Far on the left, a wall through the flames on the right.
    void buildWall(GLuint depth, GLenum attachment);
    /// Depth in [0, 1] at a distance along the axis.
    static float depthAt(double distance);

    HostTextures textures_;
    bool isBlended_ = true; ///< the settings blend media into the picture where it lies
};

extern const std::vector<ColorFormat> kColorFormats;

} // namespace fx::test
