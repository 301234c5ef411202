#include "fxsdk/assets/obj_reader.h"

#include "foundation/math/bits.h"

#include <glm/geometric.hpp>

#include <array>
#include <charconv>
#include <map>
#include <string>

namespace fx::asset {

namespace {

/// Words of one line, separated by blanks.
class Words
{
public:
    explicit Words(std::string_view line) : rest_(line) {}
    std::string_view next()
    {
        const size_t begin = rest_.find_first_not_of(" \t\r");
        if (begin == std::string_view::npos)
            return {};
        const size_t end = std::min(rest_.find_first_of(" \t\r", begin), rest_.size());
        const std::string_view word = rest_.substr(begin, end - begin);
        rest_.remove_prefix(end);
        return word;
    }

private:
    std::string_view rest_;
};

template <class T>
bool parse(std::string_view word, T& out)
{
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), out);
    return error == std::errc() && end == word.data() + word.size();
}

class Reader
{
public:
    base::Result<ObjMesh> read(std::string_view text)
    {
        for (size_t begin = 0; begin < text.size(); ++line_) {
            const size_t end = std::min(text.find('\n', begin), text.size());
            if (base::Status status = readLine(text.substr(begin, end - begin)); !status)
                return status;
            begin = end + 1;
        }
        if (mesh_.indices.empty())
            return base::Status(base::Code::Parse, "OBJ: no triangle (no line begins with f)");
        return std::move(mesh_);
    }

private:
    using Corner = std::array<int64_t, 3>; ///< position, texture, normal; -1 for none

    base::Status fault(const std::string& why) const
    {
        return {base::Code::Parse, "OBJ: line " + std::to_string(line_) + ": " + why};
    }

    base::Status readLine(std::string_view line)
    {
        Words words(line);
        const std::string_view kind = words.next();
        std::array<float, 3> v{};
        if (kind == "f")
            return readFace(words);
        const size_t count = kind == "v" || kind == "vn" ? 3 : kind == "vt" ? 2 : 0;
        for (size_t i = 0; i < count; ++i)
            if (!parse(words.next(), v[i]) || !base::isFinite(double(v[i])))
                return fault(std::to_string(count) + " finite numbers must follow " + std::string(kind));
        if (kind == "v")
            positions_.emplace_back(v[0], v[1], v[2]);
        else if (kind == "vn")
            normals_.emplace_back(v[0], v[1], v[2]);
        else if (kind == "vt")
            textures_.emplace_back(v[0], v[1]);
        return {};
    }

    /// "7", "7/2", "7//3" or "7/2/3"; negative numbers count from the last one read.
    bool readCorner(std::string_view word, Corner& out) const
    {
        const std::array<size_t, 3> sizes{positions_.size(), textures_.size(), normals_.size()};
        out = {-1, -1, -1};
        for (size_t k = 0; k < 3; ++k) {
            const size_t slash = std::min(word.find('/'), word.size());
            const std::string_view part = word.substr(0, slash);
            int64_t number = 0;
            if (!part.empty()) {
                const auto size = int64_t(sizes[k]);
                if (!parse(part, number) || number == 0 || number > size || number < -size)
                    return false;
                out[k] = number > 0 ? number - 1 : size + number;
            }
            if (slash == word.size())
                break;
            word.remove_prefix(slash + 1);
        }
        return out[0] >= 0;
    }

    base::Status readFace(Words& words)
    {
        std::vector<Corner> corners;
        for (std::string_view word = words.next(); !word.empty() && word[0] != '#'; word = words.next()) {
            Corner corner;
            if (!readCorner(word, corner))
                return fault("\"" + std::string(word.substr(0, 40)) +
                             "\" names nothing that was read before");
            corners.push_back(corner);
        }
        if (corners.size() < 3)
            return fault("a face needs three corners");
        for (size_t i = 2; i < corners.size(); ++i)
            addTriangle({corners[0], corners[i - 1], corners[i]});
        if (mesh_.indices.size() / 3 > kMostMeshTriangles)
            return {base::Code::TooLarge, "OBJ: more than the allowed " + std::to_string(kMostMeshTriangles) +
                                              " triangles: use a coarser mesh"};
        return {};
    }

    void addTriangle(const std::array<Corner, 3>& corners)
    {
        const auto place = [&](size_t i) { return positions_[size_t(corners[i][0])]; };
        const glm::vec3 across = glm::cross(place(1) - place(0), place(2) - place(0));
        const float size = glm::length(across);
        const glm::vec3 face = size > 0.0f ? across / size : glm::vec3(0.0f, 1.0f, 0.0f);
        for (const Corner& corner : corners)
            mesh_.indices.push_back(indexOf(corner, face));
    }

    uint32_t indexOf(const Corner& corner, const glm::vec3& face)
    {
        if (corner[2] >= 0) {
            const auto found = known_.find(corner);
            if (found != known_.end())
                return found->second;
        }
        glm::vec3 normal = face;
        if (corner[2] >= 0 && glm::length(normals_[size_t(corner[2])]) > 0.0f)
            normal = glm::normalize(normals_[size_t(corner[2])]);
        const auto index = uint32_t(mesh_.vertices.size());
        mesh_.vertices.push_back({positions_[size_t(corner[0])], normal,
                                  corner[1] >= 0 ? textures_[size_t(corner[1])] : glm::vec2(0.0f)});
        if (corner[2] >= 0)
            known_.emplace(corner, index);
        return index;
    }

    ObjMesh mesh_;
    std::vector<glm::vec3> positions_;
    std::vector<glm::vec3> normals_;
    std::vector<glm::vec2> textures_;
    std::map<Corner, uint32_t> known_;
    size_t line_ = 1;
};

} // namespace

base::Result<ObjMesh> readObj(std::string_view text)
{
    return Reader().read(text);
}

} // namespace fx::asset
