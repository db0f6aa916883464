UPDATE result SET value = 'text', "limit" = x'00ff', verdict = 7 WHERE name = 'kappa'; UPDATE point SET parameters = x'7b7d' WHERE id = 1;
