#include "emulate/operations.h"

#include <stddef.h>

#include <GLSL.std.450.h>
#include <spirv.h>

// Images: the coordinates stay as they are, and what is read has the sampler's precision.
static const struct sb_operation operations[] = {
    {SpvOpFAdd, SB_ROUND, 3, 2, NULL},
    {SpvOpFSub, SB_ROUND, 3, 2, NULL},
    {SpvOpFMul, SB_ROUND, 3, 2, NULL},
    {SpvOpFDiv, SB_ROUND, 3, 2, NULL},
    {SpvOpFRem, SB_ROUND, 3, 2, NULL},
    {SpvOpFMod, SB_EXPAND, 3, 2, "sb_mod"},
    {SpvOpFNegate, SB_CHANGE, 3, 1, NULL},
    {SpvOpVectorTimesScalar, SB_ROUND, 3, 2, NULL},
    {SpvOpMatrixTimesScalar, SB_ROUND, 3, 2, NULL},
    {SpvOpOuterProduct, SB_ROUND, 3, 2, NULL},
    {SpvOpVectorTimesMatrix, SB_EXPAND, 3, 2, "sb_mul"},
    {SpvOpMatrixTimesVector, SB_EXPAND, 3, 2, "sb_mul"},
    {SpvOpMatrixTimesMatrix, SB_EXPAND, 3, 2, "sb_mul"},
    {SpvOpDot, SB_EXPAND, 3, 2, "sb_dot"},
    {SpvOpTranspose, SB_MOVE, 3, 1, NULL},
    {SpvOpDPdx, SB_ROUND, 3, 1, NULL},
    {SpvOpDPdy, SB_ROUND, 3, 1, NULL},
    {SpvOpFwidth, SB_ROUND, 3, 1, NULL},
    {SpvOpConvertSToF, SB_ROUND, 3, 0, NULL},
    {SpvOpConvertUToF, SB_ROUND, 3, 0, NULL},
    {SpvOpConvertFToS, SB_COMPARE, 3, 1, NULL},
    {SpvOpConvertFToU, SB_COMPARE, 3, 1, NULL},
    {SpvOpFOrdEqual, SB_COMPARE, 3, 2, NULL},
    {SpvOpFUnordEqual, SB_COMPARE, 3, 2, NULL},
    {SpvOpFOrdNotEqual, SB_COMPARE, 3, 2, NULL},
    {SpvOpFUnordNotEqual, SB_COMPARE, 3, 2, NULL},
    {SpvOpFOrdLessThan, SB_COMPARE, 3, 2, NULL},
    {SpvOpFUnordLessThan, SB_COMPARE, 3, 2, NULL},
    {SpvOpFOrdGreaterThan, SB_COMPARE, 3, 2, NULL},
    {SpvOpFUnordGreaterThan, SB_COMPARE, 3, 2, NULL},
    {SpvOpFOrdLessThanEqual, SB_COMPARE, 3, 2, NULL},
    {SpvOpFUnordLessThanEqual, SB_COMPARE, 3, 2, NULL},
    {SpvOpFOrdGreaterThanEqual, SB_COMPARE, 3, 2, NULL},
    {SpvOpFUnordGreaterThanEqual, SB_COMPARE, 3, 2, NULL},
    {SpvOpSelect, SB_MOVE, 4, 2, NULL},
    {SpvOpVectorShuffle, SB_MOVE, 3, 2, NULL},
    {SpvOpVectorExtractDynamic, SB_MOVE, 3, 1, NULL},
    {SpvOpVectorInsertDynamic, SB_MOVE, 3, 2, NULL},
    {SpvOpCompositeInsert, SB_MOVE, 3, 2, NULL},
    {SpvOpCompositeConstruct, SB_MOVE, 3, SB_ALL_OPERANDS, NULL},
    {SpvOpCopyObject, SB_MOVE, 3, 1, NULL},
    {SpvOpImageSampleImplicitLod, SB_ROUND, 3, 0, NULL},
    {SpvOpImageSampleExplicitLod, SB_ROUND, 3, 0, NULL},
    {SpvOpImageSampleDrefImplicitLod, SB_ROUND, 3, 0, NULL},
    {SpvOpImageSampleDrefExplicitLod, SB_ROUND, 3, 0, NULL},
    {SpvOpImageSampleProjImplicitLod, SB_ROUND, 3, 0, NULL},
    {SpvOpImageSampleProjExplicitLod, SB_ROUND, 3, 0, NULL},
    {SpvOpImageSampleProjDrefImplicitLod, SB_ROUND, 3, 0, NULL},
    {SpvOpImageSampleProjDrefExplicitLod, SB_ROUND, 3, 0, NULL},
    {SpvOpImageFetch, SB_ROUND, 3, 0, NULL},
    {SpvOpImageGather, SB_ROUND, 3, 0, NULL},
    {SpvOpImageDrefGather, SB_ROUND, 3, 0, NULL},
    {SpvOpImageRead, SB_ROUND, 3, 0, NULL},
    {SpvOpBitcast, SB_ROUND, 3, 0, NULL},
    {SpvOpPhi, SB_COPY, 3, 0, NULL},
};

// determinant, inverse and the transcendental functions: the result alone, which is the best
// that hardware may do. Those that have a function may be worse (sb_emulate_rules).
static const struct sb_operation functions[] = {
    {GLSLstd450Round, SB_CHANGE, 5, 1, NULL},
    {GLSLstd450RoundEven, SB_CHANGE, 5, 1, NULL},
    {GLSLstd450Trunc, SB_CHANGE, 5, 1, NULL},
    {GLSLstd450FAbs, SB_CHANGE, 5, 1, NULL},
    {GLSLstd450FSign, SB_CHANGE, 5, 1, NULL},
    {GLSLstd450Floor, SB_CHANGE, 5, 1, NULL},
    {GLSLstd450Ceil, SB_CHANGE, 5, 1, NULL},
    {GLSLstd450FMin, SB_MOVE, 5, 2, NULL},
    {GLSLstd450FMax, SB_MOVE, 5, 2, NULL},
    {GLSLstd450FClamp, SB_MOVE, 5, 3, NULL},
    {GLSLstd450NMin, SB_MOVE, 5, 2, NULL},
    {GLSLstd450NMax, SB_MOVE, 5, 2, NULL},
    {GLSLstd450NClamp, SB_MOVE, 5, 3, NULL},
    {GLSLstd450Step, SB_MOVE, 5, 2, NULL},
    {GLSLstd450Fract, SB_ROUND, 5, 1, NULL},
    {GLSLstd450Radians, SB_ROUND, 5, 1, NULL},
    {GLSLstd450Degrees, SB_ROUND, 5, 1, NULL},
    {GLSLstd450Sin, SB_EXPAND, 5, 1, "sb_sin"},
    {GLSLstd450Cos, SB_EXPAND, 5, 1, "sb_cos"},
    {GLSLstd450Tan, SB_ROUND, 5, 1, NULL},
    {GLSLstd450Asin, SB_ROUND, 5, 1, NULL},
    {GLSLstd450Acos, SB_ROUND, 5, 1, NULL},
    {GLSLstd450Atan, SB_ROUND, 5, 1, NULL},
    {GLSLstd450Sinh, SB_ROUND, 5, 1, NULL},
    {GLSLstd450Cosh, SB_ROUND, 5, 1, NULL},
    {GLSLstd450Tanh, SB_ROUND, 5, 1, NULL},
    {GLSLstd450Asinh, SB_ROUND, 5, 1, NULL},
    {GLSLstd450Acosh, SB_ROUND, 5, 1, NULL},
    {GLSLstd450Atanh, SB_ROUND, 5, 1, NULL},
    {GLSLstd450Atan2, SB_ROUND, 5, 2, NULL},
    {GLSLstd450Exp, SB_ROUND, 5, 1, NULL},
    {GLSLstd450Log, SB_ROUND, 5, 1, NULL},
    {GLSLstd450Exp2, SB_EXPAND, 5, 1, "sb_exp2"},
    {GLSLstd450Log2, SB_EXPAND, 5, 1, "sb_log2"},
    {GLSLstd450Sqrt, SB_EXPAND, 5, 1, "sb_sqrt"},
    {GLSLstd450InverseSqrt, SB_EXPAND, 5, 1, "sb_inversesqrt"},
    {GLSLstd450Determinant, SB_ROUND, 5, 1, NULL},
    {GLSLstd450MatrixInverse, SB_ROUND, 5, 1, NULL},
    {GLSLstd450Ldexp, SB_ROUND, 5, 1, NULL},
    {GLSLstd450UnpackHalf2x16, SB_ROUND, 5, 0, NULL},
    {GLSLstd450UnpackUnorm2x16, SB_ROUND, 5, 0, NULL},
    {GLSLstd450UnpackSnorm2x16, SB_ROUND, 5, 0, NULL},
    {GLSLstd450UnpackUnorm4x8, SB_ROUND, 5, 0, NULL},
    {GLSLstd450UnpackSnorm4x8, SB_ROUND, 5, 0, NULL},
    {GLSLstd450InterpolateAtCentroid, SB_ROUND, 5, 0, NULL},
    {GLSLstd450InterpolateAtSample, SB_ROUND, 5, 0, NULL},
    {GLSLstd450InterpolateAtOffset, SB_ROUND, 5, 0, NULL},
    {GLSLstd450Pow, SB_EXPAND, 5, 2, "sb_pow"},
    {GLSLstd450FMix, SB_EXPAND, 5, 3, "sb_mix"},
    {GLSLstd450SmoothStep, SB_EXPAND, 5, 3, "sb_smoothstep"},
    {GLSLstd450Fma, SB_EXPAND, 5, 3, "sb_fma"},
    {GLSLstd450Length, SB_EXPAND, 5, 1, "sb_length"},
    {GLSLstd450Distance, SB_EXPAND, 5, 2, "sb_distance"},
    {GLSLstd450Cross, SB_EXPAND, 5, 2, "sb_cross"},
    {GLSLstd450Normalize, SB_EXPAND, 5, 1, "sb_normalize"},
    {GLSLstd450FaceForward, SB_EXPAND, 5, 3, "sb_faceforward"},
    {GLSLstd450Reflect, SB_EXPAND, 5, 2, "sb_reflect"},
    {GLSLstd450Refract, SB_EXPAND, 5, 3, "sb_refract"},
};

const struct sb_operation *sb_operation_of(const uint32_t *word, uint32_t extensions)
{
    const uint32_t op = *word & 0xffff;
    if (op == SpvOpExtInst) {
        for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
            if (word[3] == extensions && functions[i].op == word[4])
                return &functions[i];
        return NULL;
    }
    for (size_t i = 0; i < sizeof operations / sizeof *operations; i++)
        if (operations[i].op == op)
            return &operations[i];
    return NULL;
}
