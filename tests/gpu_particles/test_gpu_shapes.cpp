// Births in shapes that the GPU computes against those of the CPU.
#include "gpu_compare.h"
#include "gpu_fixture.h"

namespace fx::test {

class GpuShapes : public GpuParticleTest
{};

TEST_F(GpuShapes, areThoseOfTheCpu)
{
    const char* const shapes[] = {
        R"("point", "axis": [0.5, 1, 0])",
        R"("sphere", "size": [2, 0, 0], "inner": 0.5)",
        R"("sphere", "size": [2, 0, 0], "surface": true, "axis": [0, -1, 0])",
        R"("box", "size": [1, 2, 3], "axis": [1, 1, 1])",
        R"("box", "size": [1, 2, 3], "surface": true)",
        R"("cone", "size": [0.5, 0, 0], "angleDegrees": 20, "inner": 0.3, "axis": [0, 0.2, -1])",
        R"("cone", "size": [0.5, 0, 0], "angleDegrees": 20, "inner": 0.3, "height": 2, "axis": [0, 0.2, -1])",
        R"("cone", "size": [0.5, 0, 0], "angleDegrees": 35, "surface": true, "height": 1)",
        R"("cone", "size": [0.5, 0, 0], "angleDegrees": 0, "height": 1)",
        R"("line", "size": [3, 0, 0], "axis": [1, 0, 0])",
        R"("disc", "size": [2, 0, 0], "inner": 0.9)",
        R"("disc", "size": [2, 0, 0], "surface": true, "axis": [0, 1, 1])",
        R"("torus", "size": [2, 0, 0], "tube": 0.5, "axis": [1, 1, 0])",
        R"("torus", "size": [2, 0, 0], "tube": 0.5, "surface": true)",
    };
    const bool isSoftware = device_->limits().renderer.find("llvmpipe") != std::string::npos;
    for (const char* shape : shapes) {
        SCOPED_TRACE(shape);
        const auto text = [shape](const char* compute) {
            return std::string(R"({"version": 1, "emitters": [{"compute": ")") + compute + R"(", "shape": )" +
                   shape + R"(, "position": [0.5, 1, -2], "speed": {"min": 1, "max": 2}, "lifetime": 1,
                   "radius": 0.1, "emission": {"rate": 500}, "appearance": {"kind": "sprite"}}]})";
        };
        OneEffect cpu(schema_, load(text("cpu")), false);
        OneEffect gpu(schema_, load(text("gpu")), true);
        cpu.playTo(1.5);
        gpu.playTo(1.5);
        const base::SnapshotGroup& group = gpu.publish().group(0);
        ASSERT_TRUE(group.program());
        const Rows cpuRows = rowsOf(cpu.publish().group(0)), gpuRows = computed(group);
        EXPECT_GT(compare(cpuRows, gpuRows), 450u);
        EXPECT_EQ(isSoftware ? countDifferent(cpuRows, gpuRows) : 0, 0u);
        expectInside(cpu.publishedLast().group(0).info().bounds, group.info().bounds);
    }
}

} // namespace fx::test
