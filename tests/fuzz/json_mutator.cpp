// Changes JSON inputs of libFuzzer by their structure: members and elements are removed, repeated, exchanged
// and given other values. What is no JSON is changed byte by byte.
#include <nlohmann/json.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t maxSize);

namespace {

using Json = nlohmann::ordered_json;
using Random = std::minstd_rand;

size_t below(Random& random, size_t count)
{
    return size_t(random()) % count;
}

void collect(Json& value, std::vector<Json*>& out)
{
    out.push_back(&value);
    if (value.is_structured())
        for (Json& inner : value)
            collect(inner, out);
}

Json* anyOf(Json& root, Random& random)
{
    std::vector<Json*> all;
    collect(root, all);
    return all[below(random, all.size())];
}

Json anyNumber(const Json& old, Random& random)
{
    constexpr std::array<double, 12> kLimits{0, -1, 1, 1e-3, 0.5, 1e3, 65536, 1e5, 1e9, 1e30, -1e30, 1e-30};
    const double x = old.is_number() ? old.get<double>() : 1.0;
    switch (below(random, 5)) {
    case 0:
        return kLimits[below(random, kLimits.size())];
    case 1:
        return int64_t(kLimits[below(random, 8)]);
    case 2:
        return x * 0.5;
    case 3:
        return x * 2.0;
    default:
        return x + double(below(random, 9)) - 4.0;
    }
}

void changeScalar(Json& value, Json& root, Random& random)
{
    if (value.is_number() || below(random, 4) == 0)
        value = anyNumber(value, random);
    else if (value.is_boolean())
        value = !value.get<bool>();
    else
        value = Json(*anyOf(root, random));
}

void changeStructure(Json& value, Json& root, Random& random)
{
    const size_t at = value.empty() ? 0 : below(random, value.size());
    const auto place = [&] { return std::next(value.begin(), std::ptrdiff_t(at)); };
    const size_t choice = below(random, 4);
    if (choice == 0 && !value.empty()) {
        value.erase(place());
    } else if (choice == 1 && !value.empty()) {
        *place() = Json(*anyOf(root, random));
    } else if (value.is_array()) {
        const size_t count = choice == 2 ? 1 : 1 + below(random, 40);
        const Json element = value.empty() ? Json(1) : Json(*place());
        for (size_t i = 0; i < count; ++i)
            value.push_back(element);
    } else {
        Json* const other = anyOf(root, random); // takes a member from elsewhere
        if (other->is_object() && !other->empty()) {
            const auto taken = std::next(other->begin(), std::ptrdiff_t(below(random, other->size())));
            const std::string key = taken.key();
            const Json copy = taken.value();
            value[key] = copy;
        }
    }
}

} // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t maxSize, unsigned int seed)
{
    Random random(seed + 1);
    if (below(random, 4) == 0)
        return LLVMFuzzerMutate(data, size, maxSize);
    Json root = Json::parse(data, data + size, nullptr, false);
    if (root.is_discarded())
        return LLVMFuzzerMutate(data, size, maxSize);
    for (size_t changes = 1 + below(random, 4); changes > 0; --changes) {
        Json& value = *anyOf(root, random);
        if (value.is_structured())
            changeStructure(value, root, random);
        else
            changeScalar(value, root, random);
    }
    const std::string text = root.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (text.size() > maxSize)
        return LLVMFuzzerMutate(data, size, maxSize);
    std::memcpy(data, text.data(), text.size());
    return text.size();
}
