#include "rendering/frame_graph/frame_graph.h"

namespace fx::render {

std::string FrameGraph::versionLabel(uint32_t index) const
{
    const Version& version = versions_[index];
    std::string label("\"");
    label.append(resources_[version.resource].name).append(" #").append(std::to_string(version.resource));
    return label.append(" v").append(std::to_string(version.number)).append("\"");
}

std::string FrameGraph::toGraphviz() const
{
    std::string out("digraph frame {\n  rankdir=LR;\n");
    const auto edge = [&out](const std::string& from, const std::string& to) {
        out.append("  ").append(from).append(" -> ").append(to).append(";\n");
    };
    for (size_t i = 0; i < passes_.size(); ++i) {
        const Pass& pass = passes_[i];
        const std::string node = std::string("pass").append(std::to_string(i));
        out.append("  ").append(node).append(" [shape=box label=\"").append(pass.name).append("\"");
        out.append(pass.alive ? "];\n" : " style=dashed];\n");
        for (const Access& access : accesses(pass)) {
            const Version& version = versions_[access.version];
            if (!access.isWrite) {
                edge(versionLabel(access.version), node);
                continue;
            }
            edge(node, versionLabel(access.version));
            if (lifetimes_[version.resource].creator != i)
                edge(versionLabel(version.previous), node);
        }
    }
    return out.append("}\n");
}

} // namespace fx::render
