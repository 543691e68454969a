//! Spells text in ASCII, which compilers read in every encoding.

/// Spellings of letters beyond ASCII, ordered by code point.
const LETTERS: [(char, &str); 58] = [
    ('\u{a0}', " "),
    ('§', "section "),
    ('°', "deg"),
    ('±', "+-"),
    ('²', "^2"),
    ('³', "^3"),
    ('µ', "u"),
    ('·', "*"),
    ('Ä', "Ae"),
    ('Ö', "Oe"),
    ('×', "x"),
    ('Ü', "Ue"),
    ('ß', "ss"),
    ('ä', "ae"),
    ('ö', "oe"),
    ('ü', "ue"),
    // A dot and two dots above the letter before.
    ('\u{307}', "d"),
    ('\u{308}', "dd"),
    ('Γ', "Gamma"),
    ('Δ', "Delta"),
    ('Θ', "Theta"),
    ('Φ', "Phi"),
    ('Ψ', "Psi"),
    ('Ω', "Omega"),
    ('α', "alpha"),
    ('β', "beta"),
    ('γ', "gamma"),
    ('δ', "delta"),
    ('ε', "epsilon"),
    ('η', "eta"),
    ('θ', "theta"),
    ('κ', "kappa"),
    ('λ', "lambda"),
    ('μ', "mu"),
    ('ξ', "xi"),
    ('π', "pi"),
    ('ρ', "rho"),
    ('σ', "sigma"),
    ('τ', "tau"),
    ('φ', "phi"),
    ('ψ', "psi"),
    ('ω', "omega"),
    ('ϕ', "phi"),
    ('ᵀ', "^T"),
    ('–', "-"),
    ('—', "-"),
    ('‘', "'"),
    ('’', "'"),
    ('“', "'"),
    ('”', "'"),
    ('…', "..."),
    ('→', "->"),
    ('∂', "d"),
    ('−', "-"),
    ('√', "sqrt"),
    ('≈', "~"),
    ('≤', "<="),
    ('≥', ">="),
];

/// Returns a text in ASCII. A letter without a spelling becomes its code point: `U+1F600`.
pub(super) fn ascii(text: &str) -> String {
    let mut spelled = String::with_capacity(text.len());
    for letter in text.chars() {
        let known = LETTERS.binary_search_by_key(&letter, |(known, _)| *known);
        let code = u32::from(letter);
        // Subscript digits follow each other.
        let digit = code.checked_sub(u32::from('₀')).filter(|it| *it < 10);
        match known {
            _ if letter.is_ascii() => spelled.push(letter),
            Ok(place) => spelled += LETTERS[place].1,
            Err(_) => match digit {
                Some(digit) => spelled += &digit.to_string(),
                None => spelled += &format!("U+{code:04X}"),
            },
        }
    }
    spelled
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_text_becomes_ascii() {
        assert!(LETTERS.is_sorted_by(|one, next| one.0 < next.0));
        assert!(LETTERS.iter().all(|(_, text)| text.is_ascii()));
        for (text, expected) in [
            ("Φ_q q\u{307} = −Φ_t", "Phi_q qd = -Phi_t"),
            ("J₁ᵀ J₉ ≤ √2·π/3 m/s²", "J1^T J9 <= sqrt2*pi/3 m/s^2"),
            ("Höhe, 90°", "Hoehe, 90deg"),
            ("車 é", "U+8ECA U+00E9"),
        ] {
            assert_eq!(ascii(text), expected);
        }
    }
}
