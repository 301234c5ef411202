#include "shaders/shader_library.h"

#include <gtest/gtest.h>

namespace {

size_t countOf(const std::string& text, const std::string& what)
{
    size_t count = 0;
    for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
        ++count;
    return count;
}

} // namespace

TEST(ShaderLibrary, startsWithTheVersionAndTheDefinesThatWereAskedFor)
{
    const auto source = fx::shaders::assemble("blobs/media.frag.glsl", "FX_FORM=2 FX_DETAIL=1\nFX_LAYERS=0");
    ASSERT_TRUE(source.has_value());
    EXPECT_EQ(source->rfind("#version 450 core\n", 0), 0u);
    EXPECT_NE(source->find("#define FX_FORM 2\n"), std::string::npos);
    EXPECT_NE(source->find("#define FX_LAYERS 0\n"), std::string::npos);
}

TEST(ShaderLibrary, expandsEachIncludeOnce)
{
    const auto source = fx::shaders::assemble("blobs/media.vert.glsl", "");
    ASSERT_TRUE(source.has_value());
    EXPECT_EQ(countOf(*source, "#include"), 0u);
    EXPECT_EQ(countOf(*source, "uniform ViewBlock"), 1u);
}

TEST(ShaderLibrary, hasNoSourceForAnUnknownName)
{
    EXPECT_FALSE(fx::shaders::assemble("frame/nothing.glsl", "").has_value());
}
