/* A Pinocchio model from the numbers that benchmarks/peers/subject.py writes. */
#ifndef PINOCCHIO_MODEL_HPP
#define PINOCCHIO_MODEL_HPP

#include <pinocchio/multibody.hpp>

#include <string>
#include <vector>

#include "peer.h"

/*
 * The file holds gravity (3), then for each joint of a chain: 0 for a revolute joint or 1 for a prismatic one, about or
 * along z; the joint's rotation in its antecedent's frame (9, row-major) and its position (3) [m]; the rotor's inertia
 * [kg m2]; the body's ten dynamic parameters in Pinocchio's order. False if the file does not fit.
 */
inline bool read_model(const char *file, pinocchio::Model &model)
{
    constexpr size_t joint_size = 1 + 9 + 3 + 1 + 10;
    std::vector<double> values(3 + 64 * joint_size);
    const size_t count = peer_read(file, values.data(), values.size());
    if (count <= 3 || (count - 3) % joint_size != 0) {
        return false;
    }
    using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    model.gravity.linear() = Eigen::Map<const Eigen::Vector3d>(values.data());
    std::vector<double> armature;
    pinocchio::JointIndex last = 0;
    for (const double *at = values.data() + 3; at != values.data() + count; at += joint_size) {
        const pinocchio::SE3 place(Eigen::Map<const RowMajor>(at + 1), Eigen::Map<const Eigen::Vector3d>(at + 10));
        const std::string name = "joint " + std::to_string(armature.size() + 1);
        if (*at == 0.0) {
            last = model.addJoint(last, pinocchio::JointModelRZ(), place, name);
        } else {
            last = model.addJoint(last, pinocchio::JointModelPZ(), place, name);
        }
        armature.push_back(at[13]);
        const Eigen::Matrix<double, 10, 1> parameters = Eigen::Map<const Eigen::Matrix<double, 10, 1>>(at + 14);
        model.appendBodyToJoint(
            last, pinocchio::Inertia::FromDynamicParameters(parameters), pinocchio::SE3::Identity());
    }
    model.armature = Eigen::Map<const Eigen::VectorXd>(armature.data(), static_cast<Eigen::Index>(armature.size()));
    return true;
}

#endif
