//! Adaptive quadrature of the defining integrals, with error bounds. Shares no code with the closed forms.
