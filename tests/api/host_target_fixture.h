/// @file host_target_fixture.h
/// Draws the burning scene of ViewApiTest into textures of various formats. Each result is compared with the
/// result of an RGBA32F texture with the same light.
#pragma once

#include "tests/api/host_textures.h"
#include "tests/api/view_fixture.h"

#include <string>
#include <vector>

namespace fx::test {

/// Encoding of light in a texture format, for the expected accuracy of pictures.
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
    double step; ///< distance of neighboring values; absolute for Unorm and Srgb codes, relative for Float
    double alphaStep; ///< distance of neighboring values of alpha; 0: the format has no alpha
};

struct Outcome
{
    FxResult result;
    std::string words; ///< error message
};

double srgbDecoded(double code);
double srgbEncoded(double light);

class HostTargetTest : public ViewApiTest
{
protected:
    HostTargetTest();

    /// Sets the settings of the view.
    /// @param inPlace true: only media are drawn and blended into the picture; false: glare and shimmer are
    ///         also drawn, so that the picture is copied and written back
    void useSettings(bool inPlace, bool toneMap = false);
    Outcome render(const FxFrameDef& def);

    /// A picture whose middle has all values of [0, 1]. The media of the scene do not cover its corner.
    std::vector<float> gradient() const;
    void write(GLuint texture, const std::vector<float>& rgba);
    std::vector<float> read(GLuint texture); ///< RGBA as stored
    /// Converts stored codes to light.
    static std::vector<float> lightOf(const ColorFormat& format, std::vector<float> stored);
    /// Result of the frame in an RGBA32F texture with the initial content `light`.
    std::vector<float> reference(FxFrameDef def, const std::vector<float>& light);
    /// Compares the stored values with the reference picture. @return a message; empty if they agree
    std::string faultOf(const ColorFormat& format, const std::vector<float>& stored,
                        const std::vector<float>& expected) const;
    /// Creates a depth image. The left half is a far plane, the right half a wall through the flames.
    void buildWall(GLuint depth, GLenum attachment);
    /// Depth in [0, 1] at a distance along the axis.
    static float depthAt(double distance);

    HostTextures textures_;
    bool isBlended_ = true; ///< true: the settings blend media directly into the picture
};

extern const std::vector<ColorFormat> kColorFormats;

} // namespace fx::test
