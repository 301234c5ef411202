// Every program that a view can need, checked by a compiler that belongs to no driver.
#include "rendering/passes/programs.h"
#include "rendering/techniques/draw_techniques.h"
#include "shaders/shader_library.h"
#include "tests/tool/temporary_folder.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

namespace {

bool isInstalled()
{
    return std::system("glslangValidator --version > /dev/null 2>&1") == 0;
}

/// What glslangValidator says of one stage; empty when it has nothing against it.
std::string complaints(const char* name, const char* defines, const char* stage)
{
    const fx::test::TemporaryFolder folder;
    const auto source = fx::shaders::assemble(name, defines ? defines : "");
    if (!source)
        return std::string(name) + " does not exist";
    const std::string file = (folder / "program.").string() + stage;
    std::ofstream(file) << *source;
    const int code = std::system(("glslangValidator " + file + " > " + file + ".log 2>&1").c_str());
    std::ifstream log(file + ".log");
    const std::string text{std::istreambuf_iterator<char>(log), {}};
    return code == 0 ? "" : std::string(name) + ": " + text;
}

/// Those of the frame and of all techniques.
std::vector<const fx::render::ProgramDesc*> allPrograms()
{
    const auto frame = fx::render::framePrograms();
    std::vector<const fx::render::ProgramDesc*> programs(frame.begin(), frame.end());
    for (const fx::render::DrawTechnique* technique : fx::render::drawTechniques())
        if (technique->programs)
            programs.insert(programs.end(), technique->programs().begin(), technique->programs().end());
    return programs;
}

} // namespace

TEST(Programs, areValidForAnIndependentCompiler)
{
    if (!isInstalled())
        GTEST_SKIP() << "glslangValidator is not installed (package glslang-tools)";
    for (const fx::render::ProgramDesc* program : allPrograms()) {
        if (program->compute) {
            EXPECT_EQ(complaints(program->compute, program->defines, "comp"), "");
            continue;
        }
        EXPECT_EQ(complaints(program->vertex, program->defines, "vert"), "");
        EXPECT_EQ(complaints(program->fragment, program->defines, "frag"), "");
    }
}

TEST(Programs, areAllDifferent)
{
    const auto programs = allPrograms();
    for (size_t i = 0; i < programs.size(); ++i)
        for (size_t j = 0; j < i; ++j)
            EXPECT_NE(programs[i], programs[j]);
}
