/*
 * What the batch functions are compared with, of Pinocchio alone: pinocchio.cpp has more and takes minutes to compile.
 */
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

} // namespace

extern "C" {

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
    if (out) {
        Eigen::Map<Eigen::VectorXd>(out, model.nv) = data->tau;
    }
}

void regressor(const double *q, const double *qd, const double *qdd, double *out)
{
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    pinocchio::computeJointTorqueRegressor(model, *data, vector(q), vector(qd), vector(qdd));
    if (out) {
        Eigen::Map<RowMajor>(out, model.nv, 10 * (model.njoints - 1)) = data->jointTorqueRegressor;
    }
}
}
