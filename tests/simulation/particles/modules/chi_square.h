/// @file chi_square.h
/// Chi-square test whether counts agree with given probabilities.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace fx::test {

/// Counts of samples in cells of equal probability.
class EqualCells
{
public:
    explicit EqualCells(size_t cells) : counts_(cells) {}
    /// adds a sample; @param share value of the cumulative distribution function at the sample, 0..1
    void add(double share)
    {
        const double cell = share * double(counts_.size());
        ++counts_[cell > 0.0 ? std::min(size_t(cell), counts_.size() - 1) : 0];
    }
    void addCell(size_t cell) { ++counts_.at(cell); }

    double chiSquare() const
    {
        uint64_t all = 0;
        for (const uint64_t n : counts_)
            all += n;
        const double want = double(all) / double(counts_.size());
        double sum = 0;
        for (const uint64_t n : counts_)
            sum += (double(n) - want) * (double(n) - want) / want;
        return sum;
    }
    double degrees() const { return double(counts_.size() - 1); }

private:
    std::vector<uint64_t> counts_;
};

/// Quantile of the chi-square distribution with `degrees` degrees of freedom, by the approximation of Wilson
/// and Hilferty. The probability that a value exceeds the quantile equals the probability that a normal
/// variable exceeds z.
inline double chiSquareLimit(double degrees, double z)
{
    const double part = 2.0 / (9.0 * degrees);
    return degrees * std::pow(1.0 - part + z * std::sqrt(part), 3.0);
}

/// Quantile z of the normal distribution for each of 40 tests of the shapes. The probability that at least
/// one test fails by chance is 1 % (Sidak). The probability for one test is 1 - 0.99^(1/40) = 2.5e-4, which
/// gives z = 3.48.
constexpr double kSidak = 3.48;

inline void expectEven(const EqualCells& cells, const char* what)
{
    EXPECT_LT(cells.chiSquare(), chiSquareLimit(cells.degrees(), kSidak)) << what;
}

} // namespace fx::test
