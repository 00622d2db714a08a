/*
 * Writes the C that CasADi generates from Pinocchio's algorithms:
 *
 *     casadi_pinocchio MODEL FOLDER
 *
 * The algorithms run once on symbols of CasADi. The robot's numbers are constants to them, so that the code holds the
 * inertial parameters too and leaves out every product with zero.
 */
#include <pinocchio/autodiff/casadi.hpp>

#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/regressor.hpp>
#include <pinocchio/algorithm/rnea.hpp>

#include "pinocchio_model.hpp"

using casadi::SX;
using SymbolicModel = pinocchio::ModelTpl<SX>;
using SymbolicData = pinocchio::DataTpl<SX>;
using Vector = Eigen::Matrix<SX, Eigen::Dynamic, 1>;

static Vector vector(const SX &symbols)
{
    Vector result(symbols.size1());
    pinocchio::casadi::copy(symbols, result);
    return result;
}

template <typename Matrix> static SX expression(const Matrix &matrix)
{
    SX result;
    pinocchio::casadi::copy(matrix, result);
    return cse(densify(result));
}

int main(int count, char **words)
{
    pinocchio::Model numbers;
    if (count != 3 || !read_model(words[1], numbers)) {
        std::fprintf(stderr, "expected: casadi_pinocchio MODEL FOLDER\n");
        return 1;
    }
    const SymbolicModel model = numbers.cast<SX>();
    SymbolicData data(model);
    const SX q = SX::sym("q", model.nq), qd = SX::sym("qd", model.nv), third = SX::sym("third", model.nv);
    const Vector vq = vector(q), vqd = vector(qd), vthird = vector(third);

    casadi::Dict options;
    options["with_header"] = true;
    casadi::CodeGenerator code("casadi_pinocchio.c", options);
    const auto add = [&](const std::string &name, const std::vector<SX> &inputs, const SX &output) {
        code.add(casadi::Function("casadi_" + name, inputs, {output}));
    };

    pinocchio::rnea(model, data, vq, vqd, vthird);
    add("inverse_dynamics", {q, qd, third}, expression(data.tau));

    pinocchio::crba(model, data, vq);
    data.M.triangularView<Eigen::StrictlyLower>() = data.M.transpose().triangularView<Eigen::StrictlyLower>();
    add("inertia_matrix", {q}, expression(data.M));

    pinocchio::aba(model, data, vq, vqd, vthird);
    add("direct_dynamics", {q, qd, third}, expression(data.ddq));

    pinocchio::computeJointTorqueRegressor(model, data, vq, vqd, vthird);
    add("regressor", {q, qd, third}, expression(data.jointTorqueRegressor));

    pinocchio::computeGeneralizedGravity(model, data, vq);
    add("gravity", {q}, expression(data.g));

    code.generate(std::string(words[2]) + "/");
    return 0;
}
