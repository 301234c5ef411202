#include "benchmarks/accuracy/accuracy_measure.h"

#include "benchmarks/measure/callgrind.h"
#include "benchmarks/measure/instruction_counter.h"
#include "benchmarks/measure/option_text.h"

#include <algorithm>
#include <cstdio>

namespace fx::cli {
namespace {

base::Result<std::vector<AccuracyTask>> tasksOf(const AccuracyTechniqueEntry& entry, const std::string& scene)
{
    std::vector<AccuracyTask> tasks;
    if (!scene.empty()) {
        if (std::find(entry.scenes.begin(), entry.scenes.end(), scene) == entry.scenes.end())
            return unknownName("scene", scene, entry.scenes);
        return std::vector<AccuracyTask>{{&entry, scene}};
    }
    for (size_t i = 0; i < entry.usualScenes; ++i)
        tasks.push_back({&entry, entry.scenes[i]});
    return tasks;
}

/// All repetitions, A B C A B C.
base::Status runRounds(AccuracyTechnique& technique, const MeasureRules& rules, AccuracyCurve& ioCurve)
{
    InstructionCounter counter; // for techniques that do not count their timed part themselves
    const uint64_t all = uint64_t(rules.repetitions) * ioCurve.points.size();
    uint64_t done = 0;
    for (uint32_t round = 0; round < rules.repetitions; ++round)
        for (size_t k = 0; k < ioCurve.points.size(); ++k) {
            counter.start();
            const base::Result<AccuracySample> sample = technique.run(k, rules.stop);
            const double instructions = counter.stop();
            if (!sample)
                return sample.status();
            AccuracyPoint& point = ioCurve.points[k];
            if (round == 0)
                point.sample = *sample;
            point.seconds.push_back(sample->seconds);
            point.instructions.push_back(sample->instructions > 0 ? sample->instructions : instructions);
            if (rules.progress)
                rules.progress(++done, all);
        }
    return {};
}

void countInstructions(const AccuracyTask& task, AccuracyTechnique& technique, AccuracyCurve& ioCurve)
{
    if (!hasCallgrind() || !technique.work(0))
        return;
    const base::Result<std::vector<double>> counts =
        countUnderCallgrind(std::string(task.technique->name), task.scene, ioCurve.points.size());
    if (!counts) {
        std::fprintf(stderr, "fx accuracy: instructions are not counted: %s\n",
                     counts.status().message().c_str());
        return;
    }
    for (size_t k = 0; k < counts->size(); ++k)
        ioCurve.points[k].instructions = {(*counts)[k]};
    ioCurve.instructionsBy = "callgrind";
}

} // namespace

base::Result<std::vector<AccuracyTask>> accuracyTasks(const std::string& technique, const std::string& scene)
{
    std::vector<std::string> names;
    std::vector<AccuracyTask> all;
    for (const AccuracyTechniqueEntry& entry : accuracyTechniques()) {
        names.emplace_back(entry.name);
        if (entry.name == technique)
            return tasksOf(entry, scene);
        if (entry.hasFrames)
            continue;
        const auto tasks = tasksOf(entry, {});
        all.insert(all.end(), tasks->begin(), tasks->end());
    }
    names.emplace_back("all");
    if (technique != "all")
        return unknownName("technique", technique, names);
    if (!scene.empty())
        return base::Status(base::Code::InvalidArgument,
                            "--scene: names a scene of one technique, not of all");
    return all;
}

base::Result<AccuracyCurve> measureAccuracy(const AccuracyTask& task, const MeasureRules& rules)
{
    const std::unique_ptr<AccuracyTechnique> technique = task.technique->make(task.scene, rules.scale);
    AccuracyCurve curve{std::string(task.technique->name),
                        task.scene,
                        std::string(task.technique->item),
                        task.technique->shown,
                        {},
                        {}};
    curve.threads = task.technique->isScalable ? rules.scale.threads : 1;
    for (const AccuracySetting& setting : technique->settings())
        curve.points.push_back({setting, {}, {}, {}});
    if (base::Status status = runRounds(*technique, rules, curve); !status)
        return status;
    if (curve.points.front().instructions.front() > 0)
        curve.instructionsBy = "perf";
    else if (rules.useCallgrind)
        countInstructions(task, *technique, curve);
    return curve;
}

bool countWork(const AccuracyTask& task)
{
    const std::unique_ptr<AccuracyTechnique> technique = task.technique->make(task.scene, {});
    for (size_t k = 0; k < technique->settings().size(); ++k)
        if (!technique->work(k))
            return false;
    return true;
}

} // namespace fx::cli
