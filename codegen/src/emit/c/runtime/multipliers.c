
/* Solves a transposed Jacobian and generalized forces for the multipliers. */

LINKWRIGHT_FUNCTION linkwright_status linkwright$f_multipliers(uint16_t n, const $real jacobian[], $real forces[],
    $real reals[], uint16_t exchanges[], const linkwright$f_conditions *conditions, uint16_t block)
{
    $real *const row_scales = &reals[((size_t)n * n) + n];
    $real *const column_scales = &row_scales[n];
    const linkwright$f_equations equations = {n, 0U, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, exchanges};
    linkwright$f_factorization factorization;
    for (size_t row = 0U; row < n; row += 1U) {
        $real largest = 0.0$f;
        for (size_t column = 0U; column < n; column += 1U) {
            largest = larger$f(largest, fabs$f(jacobian[(row * n) + column]));
        }
        row_scales[row] = (largest > 0.0$f) ? largest : 1.0$f;
        column_scales[row] = 1.0$f;
    }
    const Verdict$f verdict =
        factorized$f(&factorization, jacobian, &equations, row_scales, column_scales, 0.0$f, reals);
    if (verdict.status != LINKWRIGHT_OK) {
        return noted$f(conditions->failure, verdict.status, verdict.value, verdict.column, conditions->t, block);
    }
    for (size_t k = 0U; k < n; k += 1U) {
        forces[k] *= factorization.column_factors[k];
    }
    solve_scaled_transposed$f(&factorization, forces);
    for (size_t k = 0U; k < n; k += 1U) {
        forces[k] *= factorization.row_factors[k];
    }
    if (!linkwright$f_all_finite(forces, n)) {
        return linkwright$f_not_finite(conditions, block);
    }
    return LINKWRIGHT_OK;
}
