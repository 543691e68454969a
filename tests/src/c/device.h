/* Declarations of CUDA that generated code and its kernels need, so that clang compiles them without CUDA's headers. */
#pragma once
#include <cmath>
#include <cstring>
#include <math.h>
#include <string.h>

#define __host__ __attribute__((host))
#define __device__ __attribute__((device))
#define __global__ __attribute__((global))
#define DEVICE static __device__ inline

DEVICE double fabs(double x) { return __builtin_fabs(x); }
DEVICE float fabsf(float x) { return __builtin_fabsf(x); }
DEVICE double sqrt(double x) { return __nvvm_sqrt_rn_d(x); }
DEVICE float sqrtf(float x) { return __nvvm_sqrt_rn_f(x); }
DEVICE double floor(double x) { return __nvvm_floor_d(x); }
DEVICE float floorf(float x) { return __nvvm_floor_f(x); }
DEVICE double copysign(double x, double sign) { return __builtin_copysign(x, sign); }
DEVICE float copysignf(float x, float sign) { return __builtin_copysignf(x, sign); }
DEVICE double round(double x) { return __builtin_round(x); }
DEVICE float roundf(float x) { return __builtin_roundf(x); }
DEVICE double ldexp(double x, int power)
{
    for (; power > 0; power--) { x *= 2.0; }
    for (; power < 0; power++) { x *= 0.5; }
    return x;
}
DEVICE float ldexpf(float x, int power) { return (float)ldexp((double)x, power); }
DEVICE void *memcpy(void *to, const void *from, size_t size) { return __builtin_memcpy(to, from, size); }
DEVICE void *memset(void *to, int value, size_t size) { return __builtin_memset(to, value, size); }

struct dim3 {
    unsigned x, y, z;
    __host__ __device__ dim3(unsigned x, unsigned y = 1, unsigned z = 1) : x(x), y(y), z(z) {}
};
#define blockIdx (dim3(__nvvm_read_ptx_sreg_ctaid_x()))
#define blockDim (dim3(__nvvm_read_ptx_sreg_ntid_x()))
#define threadIdx (dim3(__nvvm_read_ptx_sreg_tid_x()))

typedef int cudaError_t;
typedef struct CUstream_st *cudaStream_t;
enum { cudaSuccess = 0 };
enum cudaLimit { cudaLimitStackSize };
cudaError_t cudaConfigureCall(dim3 blocks, dim3 threads, size_t shared = 0, cudaStream_t stream = 0);
cudaError_t cudaDeviceSetLimit(cudaLimit limit, size_t value);
cudaError_t cudaDeviceSynchronize();
template <typename T> cudaError_t cudaMallocManaged(T **memory, size_t size);
cudaError_t cudaFree(void *memory);
