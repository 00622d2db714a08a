/*
 * Pinocchio's algorithms, instantiated here so that they have the flags of every other library. The wheel's own
 * instantiations are built for the oldest processor that it supports.
 */
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/regressor.hpp>
#include <pinocchio/algorithm/rnea.hpp>

#include <memory>

#include "peer.h"
#include "pinocchio_model.hpp"

namespace
{

pinocchio::Model model;
std::unique_ptr<pinocchio::Data> data;

using Vector = Eigen::Map<const Eigen::VectorXd>;

Vector vector(const double *values)
{
    return Vector(values, model.nv);
}

template <typename Result> void copy(const Result &result, double *out)
{
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    if (out) {
        Eigen::Map<RowMajor>(out, result.rows(), result.cols()) = result;
    }
}

} // namespace

extern "C" {

PEER const int peer_keeps_results = 1;

int peer_load(const char *file)
{
    if (!read_model(file, model)) {
        return 1;
    }
    data = std::make_unique<pinocchio::Data>(model);
    return 0;
}

void inverse_dynamics(const double *q, const double *qd, const double *qdd, double *out)
{
    pinocchio::rnea(model, *data, vector(q), vector(qd), vector(qdd));
    copy(data->tau, out);
}

void inertia_matrix(const double *q, const double *, const double *, double *out)
{
    pinocchio::crba(model, *data, vector(q));
    if (out) {
        data->M.triangularView<Eigen::StrictlyLower>() = data->M.transpose();
    }
    copy(data->M, out);
}

void direct_dynamics(const double *q, const double *qd, const double *tau, double *out)
{
    pinocchio::aba(model, *data, vector(q), vector(qd), vector(tau));
    copy(data->ddq, out);
}

void regressor(const double *q, const double *qd, const double *qdd, double *out)
{
    pinocchio::computeJointTorqueRegressor(model, *data, vector(q), vector(qd), vector(qdd));
    copy(data->jointTorqueRegressor, out);
}

void gravity(const double *q, const double *, const double *, double *out)
{
    pinocchio::computeGeneralizedGravity(model, *data, vector(q));
    copy(data->g, out);
}
}
