/*
 * Pinocchio over many samples, as a C++ program of its user has it: MODEL SAMPLES RESULTS.
 *
 * MODEL is a saved model; SAMPLES holds q, qd, qdd of each sample as doubles. Prints the nanoseconds of processor time a sample of
 * computeJointTorqueRegressor and of rnea, the best of five passes each; RESULTS receives the regressors (row-major) and
 * the torques of the first 200 samples.
 */
#include <pinocchio/algorithm/regressor.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <pinocchio/multibody.hpp>
#include <pinocchio/serialization.hpp>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

namespace
{
template <typename Work> double best(std::size_t samples, Work work)
{
    double least = 1e300;
    for (int pass = 0; pass < 5; ++pass) {
        const std::clock_t begin = std::clock();
        for (std::size_t k = 0; k < samples; ++k) {
            work(k);
        }
        const double taken = 1e9 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
        least = std::min(least, taken / static_cast<double>(samples));
    }
    return least;
}
} // namespace

int main(int, char **arguments)
{
    pinocchio::Model model;
    pinocchio::serialization::loadFromBinary(model, std::string(arguments[1]));
    pinocchio::Data data(model);
    std::ifstream file(arguments[2], std::ios::binary | std::ios::ate);
    std::vector<double> values(static_cast<std::size_t>(file.tellg()) / sizeof(double));
    file.seekg(0);
    file.read(reinterpret_cast<char *>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(double)));
    const auto nv = static_cast<std::size_t>(model.nv);
    const std::size_t samples = values.size() / (3 * nv);
    const auto part = [&](std::size_t k, std::size_t signal) {
        return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(&values[(3 * k + signal) * nv], model.nv));
    };
    std::vector<Eigen::VectorXd> q, v, a;
    for (std::size_t k = 0; k < samples; ++k) {
        q.push_back(part(k, 0));
        v.push_back(part(k, 1));
        a.push_back(part(k, 2));
    }
    const double regressor =
        best(samples, [&](std::size_t k) { pinocchio::computeJointTorqueRegressor(model, data, q[k], v[k], a[k]); });
    const double torque = best(samples, [&](std::size_t k) { pinocchio::rnea(model, data, q[k], v[k], a[k]); });
    std::ofstream out(arguments[3], std::ios::binary);
    for (std::size_t k = 0; k < 200; ++k) {
        const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> W =
            pinocchio::computeJointTorqueRegressor(model, data, q[k], v[k], a[k]);
        out.write(reinterpret_cast<const char *>(W.data()), static_cast<std::streamsize>(W.size() * 8));
        const Eigen::VectorXd tau = pinocchio::rnea(model, data, q[k], v[k], a[k]);
        out.write(reinterpret_cast<const char *>(tau.data()), static_cast<std::streamsize>(tau.size() * 8));
    }
    std::printf("%.3f %.3f\n", regressor, torque);
    return 0;
}
